#include "MrptScanner.hpp"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "ortung/base/Angles.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/devices/Port.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kOpening{30};  ///< a SICK is looked for at three speeds
constexpr std::chrono::milliseconds kLook{200};
constexpr std::size_t kLongestLine = 1u << 17;  ///< 8192 beams
constexpr std::size_t kBeforeRanges = 3;        ///< words
constexpr int kMostAtOnce = 64;                 ///< scans of one read()
constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();
constexpr std::string_view kError = "# error ";

}  // namespace

MrptScanner::MrptScanner(std::string name, std::vector<std::string> arguments)
    : name_(std::move(name)), arguments_(std::move(arguments)) {}

void MrptScanner::serve(std::span<const SensorData* const> features) {
  if (features.size() != 1 || !isOf(*features.front(), formats::kScan))
    throw std::invalid_argument("a scanner fills one scan and nothing else");
  id_ = features.front()->id();
  scan_ = ScanData::configOf(features.front()->format());
}

void MrptScanner::open() {
  beams_.clear();
  // The program takes long to start, so it is not for a port that is not there.
  if (name_.starts_with('/') && ::access(name_.c_str(), F_OK) != 0)
    throw DeviceAbsent(name_ + ": " + std::generic_category().message(errno));
  child_ = std::make_unique<ChildProcess>(findHelper("ortung-mrpt-device", name_), arguments_,
                                          kLongestLine);
  const Clock::time_point end = Clock::now() + kOpening;
  while (Clock::now() < end) {
    const auto line = child_->next(kLook);
    if (!line) continue;
    if (*line == "# open") return;
    if (line->starts_with(kError)) throw DeviceAbsent(name_ + ": " + line->substr(kError.size()));
  }
  throw DeviceAbsent(name_ + ": the driver has not found the scanner in " +
                     std::to_string(kOpening.count()) + " s");
}

void MrptScanner::read(std::chrono::milliseconds patience, std::vector<DeviceReading>& readings) {
  // A scanner that floods must neither fill the memory nor keep the thread from its end.
  auto line = child_->next(patience);
  for (int i = 0; line; line = ++i < kMostAtOnce ? child_->next() : std::nullopt)
    take(*line, readings);
  // Of scans that waited here, none but the newest has the stamp of its arrival.
  if (readings.size() > 1 && !readings.back().deviceTime)
    readings.erase(readings.begin(), readings.end() - 1);
}

void MrptScanner::take(const std::string& line, std::vector<DeviceReading>& readings) {
  if (line.starts_with(kError)) throw DeviceAbsent(name_ + ": " + line.substr(kError.size()));
  const auto message = parseLine(line);
  if (!message || message->words.size() <= kBeforeRanges) {
    ++refused_;
    return;
  }
  const auto& words = message->words;
  const std::size_t beams = words.size() - kBeforeRanges;
  constexpr double kFine = 1e-8;
  if (beams_.empty() || beams != given_)
    matchBeams((static_cast<double>(words[0]) - 2147483648.0) * kFine,
               static_cast<double>(words[1]) * kFine, beams);
  std::vector<float> ranges;
  for (const std::size_t beam : beams_) {
    const std::uint32_t word = words[kBeforeRanges + beam];
    const float metres = static_cast<float>(word) * 0.001F;
    ranges.push_back(word == 0          ? std::numeric_limits<float>::quiet_NaN()
                     : word == kNothing ? std::numeric_limits<float>::infinity()
                                        : metres);
  }
  DeviceReading reading;
  ScanData::encode(ranges, scan_.maxRange, reading.words);
  if (words[2] == 1) reading.deviceTime = message->stamp;
  readings.push_back(std::move(reading));
}

/// Which of the scanner's beams are those of the feature.
void MrptScanner::matchBeams(double firstAngle, double angleStep, std::size_t beams) {
  const auto refuse = [&] {
    throw DeviceMisfit(name_ + ": gives " + std::to_string(beams) + " beams from " +
                       std::to_string(degrees(firstAngle)) + " in steps of " +
                       std::to_string(degrees(angleStep)) + " degrees, the robot file says " +
                       std::to_string(scan_.beams) + " from " +
                       std::to_string(degrees(scan_.firstAngle)) + " in steps of " +
                       std::to_string(degrees(scan_.angleStep)));
  };
  beams_.clear();
  if (!(angleStep > 0.0)) refuse();
  for (int i = 0; i < scan_.beams; ++i) {
    const double place = (scan_.firstAngle + i * scan_.angleStep - firstAngle) / angleStep;
    const double nearest = std::round(place);
    constexpr double kOff = 0.1;  // of a step
    if (nearest < 0.0 || nearest >= static_cast<double>(beams) || std::abs(place - nearest) > kOff)
      refuse();
    beams_.push_back(static_cast<std::size_t>(nearest));
  }
  given_ = beams;
}

}  // namespace ortung

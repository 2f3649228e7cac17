#include "ortung/realsensors/ScanLog.hpp"

#include <stdexcept>

#include "ortung/core/SourceOptions.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/realsensors/MapFiles.hpp"

namespace ortung {
namespace {

constexpr double kDefaultPeriod = 1.0;  // [s] between scans whose stamps are lost

}  // namespace

ScanLogSource::ScanLogSource(const Parameters& options)
    : path_(options.text("path")),
      scannerOptions_(options),
      period_(optionNumber(options, "period_s", {1e-3, 3600})),
      scanClock_(optionNumber(options, "jitter_s", 1.0, {0, 3600})),
      odometryClock_(scanClock_),
      truthClock_(scanClock_),
      commandClock_(scanClock_) {
  options.textOr("robot_file", "");  // accepted but not used: the log describes its own scanner
}

ScanLogSource::~ScanLogSource() = default;

void ScanLogSource::useScanner(const LogFile& file, const Scanner& scanner) {
  scanner_ = scannerOptions_.apply(scanner, file.place());
}

void ScanLogSource::addScan(const LogFile& file, Timestamp stamp, std::size_t first,
                            const std::optional<Pose2>& odometry) {
  for (int beam = 0; beam < scanner_->beams; ++beam) {
    const double range = file.number(first + static_cast<std::size_t>(beam), "a range [m]",
                                     {-kMaxLogMetres, kMaxLogMetres});
    scanWords_.push_back(range > 0 ? words::fromMetres(range) : 0);  // 0: no valid measurement
  }
  if (!scanStamps_.empty() && stamp == lastRaw_) ++standing_;
  lastRaw_ = stamp;
  scanStamps_.push_back(scanClock_(file, stamp));
  if (odometry) scanOdometry_.push_back({scanStamps_.back(), *odometry});
}

void ScanLogSource::addOdometry(const LogFile& file, Timestamp stamp, const Pose2& pose) {
  odometry_.push_back({odometryClock_(file, stamp), pose});
}

void ScanLogSource::addTruth(const LogFile& file, Timestamp stamp, const Pose2& pose) {
  truth_.push_back({truthClock_(file, stamp), pose});
}

void ScanLogSource::addCommand(const LogFile& file, Timestamp stamp, double v, double w) {
  commands_.push_back({commandClock_(file, stamp), v, w});
}

/// Sets stamps in the order of lines, for logs whose stamps have lost their digits.
void ScanLogSource::setInLineOrder(const std::string& where) {
  const auto wrong = [&](const std::string& what, std::size_t found) {
    throw std::runtime_error(where + ": found " + std::to_string(found) + " " + what + " for " +
                             std::to_string(scanStamps_.size()) +
                             " scans, expected one a scan, since the stamps of the scans are not"
                             " used (they do not change, or the option period_s is set)");
  };
  if (!truth_.empty() && truth_.size() != scanStamps_.size())
    wrong("reference poses", truth_.size());
  if (!scanOdometry_.empty() && scanOdometry_.size() != scanStamps_.size()) {
    wrong("poses of odometry", scanOdometry_.size());
  }
  if (!odometry_.empty()) wrong("poses of an odometry of its own", odometry_.size());
  const Timestamp first = scanStamps_.front();
  const double period = period_.value_or(kDefaultPeriod);
  for (std::size_t i = 0; i < scanStamps_.size(); ++i) {
    scanStamps_[i] = first + fromSeconds(period * static_cast<double>(i));
    if (!scanOdometry_.empty()) scanOdometry_[i].stamp = scanStamps_[i];
    if (!truth_.empty()) truth_[i].stamp = scanStamps_[i];
  }
}

void ScanLogSource::finishLog(const std::string& where) {
  if (scanStamps_.empty())
    throw std::runtime_error(where + ": found no scan, expected at least one");
  if (period_ || standing_ * 10 > scanStamps_.size()) setInLineOrder(where);
  const auto odometryId = addFeature({"odometry", "odometry", "pose"});
  const auto scanId = addFeature({"laser", "LRF", "scan"});
  const auto truthId = addFeature({"reference", "groundTruth", "pose"});
  std::size_t command = 0;
  PoseOdometry odometry;  // of one of the two only, since their frames differ
  for (const auto& [stamp, pose] : odometry_.empty() ? scanOdometry_ : odometry_) {
    std::vector<std::uint32_t> reading = odometry.words(stamp, pose);
    while (command + 1 < commands_.size() && commands_[command + 1].stamp <= stamp) ++command;
    if (!commands_.empty()) {
      const bool known = commands_[command].stamp <= stamp;
      reading.push_back(words::fromSignedMetres(known ? commands_[command].v : 0.0));
      reading.push_back(words::fromRate(known ? commands_[command].w : 0.0));
    }
    add(odometryId, stamp, reading);
  }
  remark_ = odometry.remark();
  const auto beams = static_cast<std::size_t>(scanner_->beams);
  for (std::size_t i = 0; i < scanStamps_.size(); ++i) {
    add(scanId, scanStamps_[i], std::span(scanWords_).subspan(i * beams, beams));
  }
  for (const auto& [stamp, pose] : truth_) add(truthId, stamp, PoseData::encode(pose));
  scanWords_ = {};
  finish(where);
}

std::string ScanLogSource::robotToml() const {
  return robotHead(path_) + scannerToml(*scanner_, medianPeriod(scanStamps_));
}

void ScanLogSource::writeWorld(const std::filesystem::path& file) const {
  if (map_.empty()) {
    throw std::runtime_error(path_ + ": found no map, expected one; the option map=FILE names it");
  }
  writeGridWorld(file, map_);
}

std::vector<SourceOption> withScanLogOptions(std::vector<SourceOption> options) {
  options = withScannerOptions(std::move(options));
  options.push_back({"jitter_s", "s", "1", "how far stamps may fall back before it is an error"});
  options.push_back({"period_s", "s", "the log's stamps",
                     "time between scans, in the order of lines; their stamps are ignored"});
  return options;
}

}  // namespace ortung

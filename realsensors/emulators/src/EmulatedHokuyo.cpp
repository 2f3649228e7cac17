#include "ortung/emulators/EmulatedHokuyo.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr std::size_t kLongestCommand = 64;
constexpr std::size_t kBlock = 64;                ///< number of characters of a line of data
constexpr std::uint32_t kNothing = 65533;         ///< range that means that nothing is seen [mm]
constexpr std::uint32_t kError = 6;               ///< code of an error; ranges below 20 are such
constexpr std::uint32_t kMostShort = 4095;        ///< greatest range in two characters [mm]
constexpr Timestamp kClock = Timestamp{1} << 24;  ///< period of the clock's stamps [ms]
constexpr std::string_view kRight = "00";
constexpr std::string_view kScan = "99";
constexpr std::string_view kUnknown = "0E";

/// Returns the checksum: six bits of the sum of all characters.
char sumOf(std::string_view text) {
  unsigned sum = 0;
  for (const char c : text) sum += static_cast<unsigned char>(c);
  return static_cast<char>((sum & 0x3FU) + 0x30U);
}

std::string withSum(std::string_view text) { return std::string(text) + sumOf(text) + '\n'; }

/// Appends a number as characters of six bits each.
void appendCode(std::string& text, std::uint32_t value, int characters) {
  for (int i = characters - 1; i >= 0; --i)
    text += static_cast<char>(((value >> (6 * i)) & 0x3FU) + 0x30U);
}

std::optional<int> numberOf(const std::string& text, std::size_t begin, std::size_t size) {
  int number = 0;
  const char* const first = text.data() + begin;
  const auto [rest, error] = std::from_chars(first, first + size, number);
  if (error != std::errc() || rest != first + size) return std::nullopt;
  return number;
}

/// Returns a line of an answer: "KEY:value;sum".
std::string field(std::string_view text) { return std::string(text) + ';' + sumOf(text) + '\n'; }

}  // namespace

EmulatedHokuyo::EmulatedHokuyo(const ScanData& scan, std::optional<int> baud)
    : id_(scan.id()),
      maxRange_(scan.config().maxRange),
      stepsOfTurn_(static_cast<int>(std::lround(kTurn / scan.config().angleStep))),
      firstStep_(0),
      lastStep_(scan.config().beams - 1),
      frontStep_(
          static_cast<int>(std::lround(-scan.config().firstAngle / scan.config().angleStep))),
      baud_(baud),
      lines_(kLongestCommand) {
  const double off = kTurn / stepsOfTurn_ - scan.config().angleStep;
  const double front = -scan.config().firstAngle / scan.config().angleStep - frontStep_;
  if (std::abs(off) * scan.config().beams > 0.1 * scan.config().angleStep || frontStep_ < 0 ||
      std::abs(front) > 0.1)
    throw std::invalid_argument(
        toText(id_) +
        " has beams that no Hokuyo has: expected an angle_step_deg that divides 360, and a beam "
        "straight ahead");
}

void EmulatedHokuyo::receive(std::string_view bytes, Timestamp now) {
  lines_.add(bytes);
  while (const auto line = lines_.next()) execute(*line, now);
}

void EmulatedHokuyo::answer(const std::string& echo, std::string_view status, std::string_view data,
                            Timestamp now) {
  send(echo + '\n' + withSum(status) + std::string(data) + '\n', now);
}

void EmulatedHokuyo::execute(const std::string& line, Timestamp now) {
  const std::string name = line.substr(0, 2);
  if (name == "VV") return answer(line, kRight, versions(), now);
  if (name == "PP") return answer(line, kRight, parameters(), now);
  if (name == "II") {
    std::string stamp = "TIME:" + timeOf(now);
    return answer(line, kRight,
                  field(isOn_ ? "LASR:ON" : "LASR:OFF") + field("MESM:Normal") + field(stamp) +
                      field("STAT:Stable 000 no error."),
                  now);
  }
  if (name == "QT" || name == "RS" || name == "RT") {
    measures_ = false;
    isOn_ = false;
    return answer(line, kRight, "", now);
  }
  if (name == "BM") {
    const bool wasOn = isOn_;
    isOn_ = true;
    return answer(line, wasOn ? "02" : kRight, "", now);
  }
  if (name == "TM") {
    if (line.starts_with("TM1")) return answer(line, kRight, withSum(timeOf(now)), now);
    return answer(line, kRight, "", now);
  }
  if (name == "SS") {
    const auto speed = line.size() >= 8 ? numberOf(line, 2, 6) : std::nullopt;
    if (!baud_ || !speed || *speed < 19200) return answer(line, kUnknown, "", now);
    const bool isSame = *baud_ == *speed;
    answer(line, isSame ? "03" : kRight, "", now);
    baud_ = *speed;
    return;
  }
  if (name == "CR" || name == "HS" || line == "SCIP2.0") return answer(line, kRight, "", now);
  if (name == "MD" || name == "MS" || name == "GD" || name == "GS") return measure(line, now);
  answer(line, kUnknown, "", now);
}

std::optional<EmulatedHokuyo::Request> EmulatedHokuyo::requestOf(const std::string& line) const {
  const bool isContinuous = line[0] == 'M';
  const std::string command = line.substr(0, line.find(';'));
  if (command.size() != (isContinuous ? 15U : 12U)) return std::nullopt;
  const auto first = numberOf(line, 2, 4);
  const auto last = numberOf(line, 6, 4);
  const auto cluster = numberOf(line, 10, 2);
  const auto skip = isContinuous ? numberOf(line, 12, 1) : std::optional(0);
  const auto count = isContinuous ? numberOf(line, 13, 2) : std::optional(1);
  if (!first || !last || !cluster || !skip || !count) return std::nullopt;
  if (*first < firstStep_ || *last > lastStep_ || *first > *last) return std::nullopt;
  return Request{line, *first, *last, std::max(*cluster, 1), *skip, *count, line[1] == 'S'};
}

void EmulatedHokuyo::measure(const std::string& line, Timestamp now) {
  const auto request = requestOf(line);
  if (!request) return answer(line, "05", "", now);  // the scanner does not have these steps
  if (line[0] == 'G') {
    if (!isOn_ || !newest_) return answer(line, "10", "", now);  // the laser is off
    return sendScan(*request, *newest_, now);
  }
  isOn_ = true;  // this command switches it on
  measures_ = true;
  request_ = *request;
  skipped_ = 0;
  answer(line, kRight, "", now);
}

void EmulatedHokuyo::sense(const Message& reading, Timestamp now) {
  if (reading.id != id_) return;
  newest_ = reading;
  if (!measures_ || isBusy(now)) return;
  if (skipped_++ < request_.skip) return;
  skipped_ = 0;
  sendScan(request_, reading, now);
  if (request_.left > 0 && --request_.left == 0) measures_ = false;
}

void EmulatedHokuyo::sendScan(const Request& request, const Message& reading, Timestamp now) {
  const auto code = [&](int step) {
    const auto index = static_cast<std::size_t>(step - firstStep_);
    const std::uint32_t word = index < reading.words.size() ? reading.words[index] : 0;
    if (word == 0) return kError;
    if (word >= std::lround(1000.0 * maxRange_)) return kNothing;
    return std::max(word, 20U);
  };
  std::string ranges;
  for (int step = request.first; step <= request.last; step += request.cluster) {
    std::uint32_t nearest = code(step);
    for (int i = 1; i < request.cluster && step + i <= request.last; ++i)
      nearest = std::min(nearest, code(step + i));
    if (request.isShort)
      appendCode(ranges, std::min(nearest, kMostShort), 2);
    else
      appendCode(ranges, nearest, 3);
  }
  std::string data = withSum(timeOf(now));
  for (std::size_t i = 0; i < ranges.size(); i += kBlock) data += withSum(ranges.substr(i, kBlock));
  answer(request.echo, request.echo[0] == 'G' ? kRight : kScan, data, now);
}

std::string EmulatedHokuyo::timeOf(Timestamp now) const {
  std::string text;
  appendCode(text, static_cast<std::uint32_t>((clock.at(now) / 1000) % kClock), 4);
  return text;
}

std::string EmulatedHokuyo::versions() const {
  return field("VEND:Ortung emulator") + field("PROD:SCIP 2.0 scanner") + field("FIRM:1.0") +
         field("PROT:SCIP 2.0") + field("SERI:0000001");
}

std::string EmulatedHokuyo::parameters() const {
  const auto number = [](const char* name, int value) {
    return field(name + std::to_string(value));
  };
  return field("MODL:EMULATOR(Ortung)") + number("DMIN:", 20) +
         number("DMAX:", static_cast<int>(std::lround(1000.0 * maxRange_))) +
         number("ARES:", stepsOfTurn_) + number("AMIN:", firstStep_) + number("AMAX:", lastStep_) +
         number("AFRT:", frontStep_) + number("SCAN:", 600);
}

}  // namespace ortung

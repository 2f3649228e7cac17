#include "ortung/devices/BaseLines.hpp"

#include <algorithm>
#include <boost/crc.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace base_lines {
namespace {

constexpr std::size_t kMostMotionData = 16;
constexpr std::size_t kMostNumbers = 80;
constexpr std::int64_t kFarthest = 2'000'000'000;  ///< greatest number but motion data and time

std::uint16_t checksum(std::string_view text) {
  boost::crc_ccitt_type crc;
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
}

std::int64_t rounded(double value) {
  const auto most = static_cast<double>(kFarthest);
  return std::llround(std::clamp(value, -most, most));
}

void append(std::string& text, std::int64_t number) {
  text += ',';
  text += std::to_string(number);
}

std::string bodyOf(const Odometry& o) {
  std::string text = "O";
  append(text, o.time);
  append(text, rounded(1000.0 * o.pose.x));
  append(text, rounded(1000.0 * o.pose.y));
  append(text, rounded(100.0 * degrees(o.pose.theta)));
  append(text, rounded(1000.0 * o.translationalVelocity));
  append(text, rounded(100.0 * degrees(o.rotationalVelocity)));
  append(text, rounded(1000.0 * o.lateralVelocity));
  for (const std::uint32_t word : o.motionData) append(text, word);
  return text;
}

std::string bodyOf(const Sonars& s) {
  std::string text = "S";
  append(text, s.time);
  append(text, static_cast<std::int64_t>(s.first));
  for (const std::uint32_t echo : s.echoes) append(text, echo);
  return text;
}

std::string bodyOf(const Identity& i) {
  std::string text = "I";
  append(text, i.version);
  append(text, static_cast<std::int64_t>(i.sonars));
  return text;
}

std::string bodyOf(const Velocity& v) {
  std::string text = "V";
  append(text, rounded(1000.0 * v.translational));
  append(text, rounded(100.0 * degrees(v.rotational)));
  return text;
}

std::string bodyOf(const Question&) { return "?I"; }

/// Returns the characters between "$" and "*", if the checksum is right.
std::optional<std::string_view> checked(std::string_view line) {
  line.remove_prefix(std::min(line.rfind('$'), line.size()));  // noise may precede it
  if (line.size() < 7 || line.size() > kLongest || line.front() != '$') return std::nullopt;
  const std::size_t star = line.size() - 5;
  if (line[star] != '*') return std::nullopt;
  std::uint16_t stated = 0;
  const char* const end = line.data() + line.size();
  const auto [rest, error] = std::from_chars(line.data() + star + 1, end, stated, 16);
  if (error != std::errc() || rest != end) return std::nullopt;
  const std::string_view body = line.substr(1, star - 1);
  if (stated != checksum(body)) return std::nullopt;
  return body;
}

/// Returns all numbers behind the first comma; nothing if one of them is invalid.
std::optional<std::vector<std::int64_t>> numbersOf(std::string_view text) {
  std::vector<std::int64_t> numbers;
  while (!text.empty()) {
    if (text.front() != ',' || numbers.size() == kMostNumbers) return std::nullopt;
    text.remove_prefix(1);
    std::int64_t number = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return std::nullopt;
    numbers.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  }
  return numbers;
}

bool isWord(std::int64_t number) {
  return number >= 0 && number <= std::numeric_limits<std::uint32_t>::max();
}

bool isNear(std::int64_t number) { return number >= -kFarthest && number <= kFarthest; }

using Numbers = std::vector<std::int64_t>;

std::optional<Telegram> odometryOf(const Numbers& n) {
  if (n.size() < 7 || n.size() > 7 + kMostMotionData || !isWord(n[0])) return std::nullopt;
  if (!std::all_of(n.begin() + 1, n.begin() + 7, isNear)) return std::nullopt;
  if (!std::all_of(n.begin() + 7, n.end(), isWord)) return std::nullopt;
  Odometry o;
  o.time = static_cast<std::uint32_t>(n[0]);
  o.pose = {static_cast<double>(n[1]) / 1000.0, static_cast<double>(n[2]) / 1000.0,
            wrapAngle(radians(static_cast<double>(n[3]) / 100.0))};
  o.translationalVelocity = static_cast<double>(n[4]) / 1000.0;
  o.rotationalVelocity = radians(static_cast<double>(n[5]) / 100.0);
  o.lateralVelocity = static_cast<double>(n[6]) / 1000.0;
  for (std::size_t i = 7; i < n.size(); ++i)
    o.motionData.push_back(static_cast<std::uint32_t>(n[i]));
  return o;
}

std::optional<Telegram> sonarsOf(const Numbers& n) {
  if (n.size() < 3 || !std::all_of(n.begin(), n.end(), isWord)) return std::nullopt;
  Sonars s;
  s.time = static_cast<std::uint32_t>(n[0]);
  s.first = static_cast<std::size_t>(n[1]);
  if (s.first + (n.size() - 2) > kMostSonars) return std::nullopt;
  for (std::size_t i = 2; i < n.size(); ++i) s.echoes.push_back(static_cast<std::uint32_t>(n[i]));
  return s;
}

std::optional<Telegram> identityOf(const Numbers& n) {
  if (n.size() != 2 || !isWord(n[0]) || n[1] < 0) return std::nullopt;
  if (n[1] > static_cast<std::int64_t>(kMostSonars)) return std::nullopt;
  return Identity{static_cast<std::uint32_t>(n[0]), static_cast<std::size_t>(n[1])};
}

std::optional<Telegram> velocityOf(const Numbers& n) {
  if (n.size() != 2 || !isNear(n[0]) || !isNear(n[1])) return std::nullopt;
  return Velocity{static_cast<double>(n[0]) / 1000.0, radians(static_cast<double>(n[1]) / 100.0)};
}

}  // namespace

std::string encode(const Telegram& telegram) {
  const std::string body = std::visit([](const auto& one) { return bodyOf(one); }, telegram);
  char sum[8];
  std::snprintf(sum, sizeof(sum), "*%04X", checksum(body));
  return "$" + body + sum + "\r\n";
}

std::optional<Telegram> decode(std::string_view line) {
  const auto body = checked(line);
  if (!body || body->empty()) return std::nullopt;
  if (*body == "?I") return Question{};
  const auto numbers = numbersOf(body->substr(1));
  if (!numbers) return std::nullopt;
  switch (body->front()) {
    case 'O':
      return odometryOf(*numbers);
    case 'S':
      return sonarsOf(*numbers);
    case 'I':
      return identityOf(*numbers);
    case 'V':
      return velocityOf(*numbers);
    default:
      return std::nullopt;
  }
}

}  // namespace base_lines

void LineCutter::add(std::string_view bytes) {
  bytes_.erase(0, begin_);
  begin_ = 0;
  bytes_ += bytes;
}

std::optional<std::string> LineCutter::next() {
  while (true) {
    const std::size_t end = bytes_.find('\n', begin_);
    if (end == std::string::npos) {
      if (bytes_.size() - begin_ > longest_) {  // no line can be as long
        refused_ += isSkipping_ ? 0 : 1;
        isSkipping_ = true;
        bytes_.clear();
        begin_ = 0;
      }
      return std::nullopt;
    }
    std::string line = bytes_.substr(begin_, end - begin_);
    begin_ = end + 1;
    if (isSkipping_) {
      isSkipping_ = false;
      continue;
    }
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.size() <= longest_) return line;
    ++refused_;
  }
}

void LineCutter::clear() {
  bytes_.clear();
  begin_ = 0;
  isSkipping_ = false;
}

}  // namespace ortung

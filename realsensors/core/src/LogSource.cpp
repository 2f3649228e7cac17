#include "ortung/realsensors/LogSource.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "ortung/formats/OdometryData.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung {

LogSource::~LogSource() = default;

bool LogSource::next(Message& message) {
  if (at_ == entries_.size()) return false;
  const Entry& entry = entries_[at_++];
  message.stamp = entry.stamp;
  message.id = features_[entry.feature];
  const auto first = words_.begin() + static_cast<std::ptrdiff_t>(entry.firstWord);
  message.words.assign(first, first + entry.count);
  return true;
}

double LogSource::progress() const {
  return entries_.empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(entries_.size());
}

std::uint32_t LogSource::addFeature(SensorId id) {
  features_.push_back(std::move(id));
  return static_cast<std::uint32_t>(features_.size() - 1);
}

void LogSource::add(std::uint32_t feature, Timestamp stamp, std::span<const std::uint32_t> words) {
  entries_.push_back({stamp, feature, static_cast<std::uint32_t>(words.size()), words_.size()});
  words_.insert(words_.end(), words.begin(), words.end());
}

void LogSource::finish(const std::string& where) {
  if (entries_.empty()) {
    throw std::runtime_error(where + ": found no reading, expected at least one");
  }
  const auto moment = [](const Entry& e) { return std::pair(e.stamp, e.feature); };
  std::stable_sort(entries_.begin(), entries_.end(),
                   [&](const Entry& a, const Entry& b) { return moment(a) < moment(b); });
  const auto same = [&](const Entry& a, const Entry& b) { return moment(a) == moment(b); };
  const auto kept = std::unique(entries_.rbegin(), entries_.rend(), same);
  entries_.erase(entries_.begin(), kept.base());
}

std::vector<std::uint32_t> PoseOdometry::words(Timestamp stamp, const Pose2& pose) {
  constexpr double kShortest = 1e-3;  // [s]; in less, the clock's jitter makes huge velocities
  const double seconds = last_ ? toSeconds(stamp - last_->first) : 0.0;
  if (last_) {
    constexpr double kFar = 10.0;  // [m]; odometry is coarse, or begins anew, within less
    const double way = std::hypot(pose.x - last_->second.x, pose.y - last_->second.y);
    if (way > kFar && way > kMaxLogVelocity * seconds) ++leaps_;
  }
  if (seconds >= kShortest) {
    const Pose2 change = inverse(last_->second) * pose;
    translational_ = change.x / seconds;
    rotational_ = change.theta / seconds;
  }
  last_ = {stamp, pose};
  return OdometryData::encode({pose, translational_, rotational_, {}});
}

std::string PoseOdometry::remark() const {
  if (leaps_ == 0) return "";
  return std::to_string(leaps_) +
         " poses of odometry are more than 10 m from those before them, faster than 100 m/s";
}

Pose2 alongArc(const Pose2& pose, double v, double w, double seconds) {
  // The chord of the arc has the direction of the robot at half the time.
  const double half = w * seconds / 2;
  const double chord = v * seconds * (std::abs(half) < 1e-9 ? 1.0 : std::sin(half) / half);
  return pose * Pose2{chord * std::cos(half), chord * std::sin(half), wrapAngle(2 * half)};
}

std::vector<double> headingsOfWay(std::span<const Pose2> places, double step) {
  std::vector<double> headings(places.size(), 0.0);
  std::size_t begin = 0;
  double heading = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double dx = places[i].x - places[begin].x;
    const double dy = places[i].y - places[begin].y;
    if (std::hypot(dx, dy) < step) continue;
    heading = std::atan2(dy, dx);
    for (; begin < i; ++begin) headings[begin] = heading;
  }
  for (; begin < places.size(); ++begin) headings[begin] = heading;
  return headings;
}

std::string tomlNumber(double value) {
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
  std::string result(text.data(), end);
  if (std::isfinite(value) && result.find('.') == std::string::npos) result += ".0";
  return result;
}

std::string tomlText(const std::string& text) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (byte < 32 || byte == 127) {
      result += std::string("\\u00") + kDigits[byte >> 4] + kDigits[byte & 15];
    } else {
      result += c;
    }
  }
  return result + '"';
}

}  // namespace ortung

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string_view>
#include <thread>

#include "ortung/client/RobotSession.hpp"
#include "ortung/config/TomlFile.hpp"
#include "ortung/container/Plugin.hpp"
#include "ortung/container/Source.hpp"

namespace ortung {
namespace {

constexpr double kDefaultDuration = 60.0;  // of a simulation, which has no end of its own [s]

std::optional<double> parseNumber(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool isWhole = !text.empty() && error == std::errc() && end == text.data() + text.size();
  if (!isWhole || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// Options come as text, behind the "?" of the source.
std::optional<double> numberOption(const Parameters& p, const std::string& key, double low,
                                   double high) {
  if (!p.has(key)) return std::nullopt;
  const std::string text = p.text(key);
  const auto number = parseNumber(text);
  if (!number || *number < low || *number > high)
    p.fail(key, "is \"" + text + "\", must be a number from " + std::to_string(low) + " to " +
                    std::to_string(high));
  return number;
}

std::optional<Pose2> startOption(const Parameters& p) {
  if (!p.has("start")) return std::nullopt;
  const std::string text = p.text("start");
  const std::size_t first = std::min(text.find(','), text.size());
  const std::size_t second = std::min(text.find(',', first + 1), text.size());
  const std::string_view all = text;
  const auto x = parseNumber(all.substr(0, first));
  const auto y = parseNumber(all.substr(std::min(first + 1, text.size()), second - first - 1));
  const auto theta = parseNumber(all.substr(std::min(second + 1, text.size())));
  if (!x || !y || !theta)
    p.fail("start", "is \"" + text + "\", must be x,y,theta in metres and degrees");
  return Pose2{*x, *y, wrapAngle(*theta * std::numbers::pi / 180.0)};
}

SessionOptions readOptions(const Parameters& p) {
  SessionOptions options;
  const std::string path = p.text("path");
  const std::size_t colon = path.rfind(':');
  const std::string port = colon == path.npos ? "" : path.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), options.port);
  if (colon == path.npos || colon == 0 || error != std::errc() ||
      end != port.data() + port.size() || options.port == 0)
    p.fail("path", "is \"" + path + "\", must be HOST:PORT, e.g. 127.0.0.1:7777");
  options.host = path.substr(0, colon);
  options.name = p.textOr("name", options.name);
  options.start = startOption(p);
  options.wanders = p.choiceOr("drive", "none", {"none", "wander"}) == "wander";
  options.isBinary = p.choiceOr("form", "text", {"text", "binary"}) == "binary";
  options.patience = numberOption(p, "timeout", 0.1, 1e6).value_or(options.patience);
  if (const char* token = std::getenv("ORTUNG_TOKEN")) options.token = token;
  options.isInterruptible = true;
  return options;
}

std::string readRobotFile(const Parameters& p) {
  const std::string given = p.textOr("robot_file", "");
  const std::string file = p.textOr("robot", given);
  if (file.empty()) p.fail("robot", "is missing; the server needs a robot file");
  return readTomlText(file);
}

/// Source "tcp": a robot on the field of a message board.
class TcpSource : public Source {
 public:
  explicit TcpSource(const Parameters& p)
      : options_(readOptions(p)),
        robotToml_(readRobotFile(p)),
        isLockstep_(p.choiceOr("lockstep", "on", {"on", "off"}) == "on"),
        cycle_(numberOption(p, "cycle_ms", 1.0, 1e5).value_or(100.0) / 1000.0),
        duration_(numberOption(p, "duration", 0.0, 1e9)),
        session_(options_, robotToml_) {
    if (!duration_ && session_.kind() == "simulation") duration_ = kDefaultDuration;
    if (isLockstep_) session_.setLockstep(true);
  }
  ~TcpSource() override = default;

  bool next(Message& message) override {
    while (sent_ == frame_.size()) {
      if (!fetch()) return false;
    }
    message = std::move(frame_[sent_++]);
    if (!first_) first_ = message.stamp;
    elapsed_ = toSeconds(message.stamp - *first_);
    return !duration_ || elapsed_ <= *duration_;
  }

  double progress() const override {
    if (!duration_) return -1.0;
    return *duration_ > 0.0 ? std::min(elapsed_ / *duration_, 1.0) : 1.0;
  }
  std::string worldFingerprint() const override { return session_.worldFingerprint(); }
  std::string robotToml() const override { return robotToml_; }

 private:
  bool fetch() {
    sent_ = 0;
    frame_.clear();
    if (isLockstep_) {
      auto readings = session_.next();
      if (readings) frame_ = std::move(*readings);
      return readings.has_value();
    }
    frame_ = session_.update();
    if (!frame_.empty()) return true;
    if (session_.ask("STATUS").find("state=ended") != std::string::npos) return false;
    std::this_thread::sleep_for(std::chrono::duration<double>(cycle_));
    return true;
  }

  SessionOptions options_;
  std::string robotToml_;
  bool isLockstep_;
  double cycle_;                    ///< [s]
  std::optional<double> duration_;  ///< [s]
  RobotSession session_;
  std::vector<Message> frame_;
  std::size_t sent_ = 0;
  std::optional<Timestamp> first_;
  double elapsed_ = 0.0;  ///< [s]
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("tcp_source", ortung::provide<ortung::Source, ortung::TcpSource>("tcp"));

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <thread>

#include "ortung/client/RobotSession.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

constexpr double kDefaultDuration = 60.0;  // duration for a simulation, which has no end [s]

SessionOptions readOptions(const Parameters& p) {
  SessionOptions options;
  const std::string path = p.text("path");
  const std::size_t colon = path.rfind(':');  // [::1]:7777 is also an address
  const std::string port = colon == path.npos ? "" : path.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), options.port);
  if (colon == 0 || error != std::errc() || end != port.data() + port.size() || options.port == 0)
    p.fail("path", "is \"" + path + "\", must be HOST:PORT, e.g. 127.0.0.1:7777");
  options.host = path.substr(0, colon);
  if (options.host.starts_with('[') && options.host.ends_with(']'))
    options.host = options.host.substr(1, options.host.size() - 2);
  options.name = p.textOr("name", options.name);
  options.start = optionPose(p, "start");
  options.wanders = p.choiceOr("drive", "none", {"none", "wander"}) == "wander";
  options.isBinary = p.choiceOr("form", "binary", {"text", "binary"}) == "binary";
  options.patience = optionNumber(p, "timeout", options.patience, {0.1, 1e6});
  if (p.has("timeout")) options.timeout = std::max(options.timeout, options.patience);
  if (const char* token = std::getenv("ORTUNG_TOKEN")) options.token = token;
  options.isInterruptible = true;
  try {
    options.check();
  } catch (const std::invalid_argument& refusal) {
    throw ConfigError(p.where() + ": " + refusal.what());
  }
  return options;
}

std::string readRobotFile(const Parameters& p) {
  const std::string given = p.textOr("robot_file", "");
  const std::string file = p.textOr("robot", given);
  if (file.empty()) p.fail("robot", "is missing; the server needs a robot file");
  return readTomlText(file);
}

/// The source "tcp": a robot on the field of a message board.
class TcpSource : public Source {
 public:
  explicit TcpSource(const Parameters& p)
      : options_(readOptions(p)),
        robotToml_(readRobotFile(p)),
        isLockstep_(p.choiceOr("lockstep", "auto", {"on", "off", "auto"}) != "off"),
        cycle_(optionNumber(p, "cycle_ms", 100.0, {1.0, 1e5}) / 1000.0),
        wait_(fromSeconds(optionNumber(p, "wait_s", 0.3, {0.0, 60.0}))),
        duration_(optionNumber(p, "duration", {0.0, 1e9})),
        session_(options_, robotToml_) {
    if (!duration_ && session_.kind() == "simulation") duration_ = kDefaultDuration;
    if (isLockstep_) enterLockstep(p.textOr("lockstep", "auto") == "auto");
    if (session_.ask("STATUS").find("state=ended") != std::string::npos)
      throw std::runtime_error(options_.server() +
                               ": what it serves has ended; a record is served again and again "
                               "with --repeat");
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
  bool isLive() const override { return true; }
  std::string worldFingerprint() const override { return session_.worldFingerprint(); }
  std::string robotToml() const override { return robotToml_; }

 private:
  /// Enters lockstep. A server that runs in real time for all clients refuses it, and so does a
  /// running robot: then the source just follows.
  void enterLockstep(bool isOptional) {
    try {
      session_.setLockstep(true);
    } catch (const ServerRefused& refusal) {
      if (!isOptional || (refusal.code() != "role" && refusal.code() != "live")) throw;
      isLockstep_ = false;
    }
  }

  bool fetch() {
    sent_ = 0;
    frame_.clear();
    if (isLockstep_) {
      auto readings = session_.next();
      if (readings) frame_ = std::move(*readings);
      return readings.has_value();
    }
    std::vector<Message> news = session_.update();
    const bool isSilent = news.empty();
    if (session_.kind() == "robot")
      takeInOrder(std::move(news));
    else
      frame_ = std::move(news);
    if (!isSilent) {
      silence_ = 0.0;
      if (frame_.empty()) std::this_thread::sleep_for(std::chrono::duration<double>(cycle_));
      return true;
    }
    const std::string status = session_.ask("STATUS");
    if (status.find("state=ended") != std::string::npos) return false;
    if (silence_ > options_.patience)
      throw ConnectionLost(options_.server() + ": gave no reading for " +
                           std::to_string(options_.patience) + " s; it says " + status);
    std::this_thread::sleep_for(std::chrono::duration<double>(cycle_));
    silence_ += cycle_;
    return true;
  }

  /// Sorts readings by time. A running robot's devices have different delays: readings are held
  /// until those of the same time have had time to arrive. Readings that arrive even later are
  /// dropped.
  void takeInOrder(std::vector<Message> news) {
    std::move(news.begin(), news.end(), std::back_inserter(held_));
    std::stable_sort(held_.begin(), held_.end(),
                     [](const Message& a, const Message& b) { return a.stamp < b.stamp; });
    if (held_.empty()) return;
    const Timestamp ripe = held_.back().stamp - wait_;
    std::erase_if(held_, [this](const Message& m) { return given_ && m.stamp < *given_; });
    const auto end =
        std::find_if(held_.begin(), held_.end(), [&](const Message& m) { return m.stamp > ripe; });
    std::move(held_.begin(), end, std::back_inserter(frame_));
    held_.erase(held_.begin(), end);
    if (!frame_.empty()) given_ = frame_.back().stamp;
  }

  SessionOptions options_;
  std::string robotToml_;
  bool isLockstep_;
  double cycle_;                    ///< time between two updates without lockstep [s]
  Timestamp wait_;                  ///< how long readings of a running robot are held [us]
  std::optional<double> duration_;  ///< time from the first to the last readings [s]
  RobotSession session_;
  std::vector<Message> held_;       ///< held readings of a running robot, in the order of time
  std::optional<Timestamp> given_;  ///< stamp of the last one that was given
  std::vector<Message> frame_;
  std::size_t sent_ = 0;
  std::optional<Timestamp> first_;
  double elapsed_ = 0.0;  ///< time from the first reading to the last one [s]
  double silence_ = 0.0;  ///< time without a reading [s]
};

/// The text of `ortung import tcp --help`.
class TcpHelp : public SourceHelp {
 public:
  explicit TcpHelp(const Parameters&)
      : SourceHelp(
            "HOST:PORT of a message board",
            {{"robot", "", "--with-robot", "robot file"},
             {"duration", "s", "60 for a simulation, otherwise all",
              "time from the first to the last readings"},
             {"drive", "", "none", "wander: the server drives the robot about"},
             {"start", "m, m, deg", "anywhere", "x,y,theta"},
             {"lockstep", "", "auto",
              "on: an error where it is not permitted; off: asks every cycle_ms what is new"},
             {"cycle_ms", "ms", "100", "without lockstep: time between two updates"},
             {"wait_s", "s", "0.3",
              "how long a running robot's readings are held for delayed ones"},
             {"form", "", "binary", "format of readings on the wire; text has no pictures"},
             {"name", "", "robot", "name of client and robot"},
             {"timeout", "s", "60",
              "how long there may be no reading; where it is set, an answer may take as long, "
              "otherwise 5 s"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("tcp_source", ortung::provide<ortung::Source, ortung::TcpSource>("tcp"),
               ortung::provide<ortung::SourceHelp, ortung::TcpHelp>("tcp"));

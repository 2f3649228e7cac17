#include "ortung/client/RemoteRobot.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "ortung/core/PluginFactory.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

using std::chrono::steady_clock;

constexpr int kFirstExchanges = 8;                // of time stamps, when a connection is made
constexpr Timestamp kExchangePeriod = 1'000'000;  // afterwards [us]
constexpr double kFirstPause = 0.1;               // before connecting again [s]
constexpr double kLongestPause = 2.0;             // [s]
constexpr std::size_t kMostUntold = 100;          // troubles; then the oldest are forgotten

Timestamp steadyTime() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             steady_clock::now().time_since_epoch())
      .count();
}

/// Nearest duration that can be added to any time of the clock; @p s is not NaN.
steady_clock::duration seconds(double s) {
  constexpr double kLongest = 1e9;
  return std::chrono::duration_cast<steady_clock::duration>(
      std::chrono::duration<double>(std::clamp(s, 0.0, kLongest)));
}

RemoteOptions checked(RemoteOptions options) {
  options.session.check();
  if (!(options.cycle >= 0.0))
    throw std::invalid_argument("the cycle is " + std::to_string(options.cycle) +
                                " s, expected 0 or more");
  if (!options.clock) options.clock = steadyTime;
  return options;
}

}  // namespace

struct RemoteRobot::Parts {
  Parts(const std::filesystem::path& robotFile, const RemoteOptions& given)
      : options(checked(given)),
        robotToml(readTomlText(robotFile)),
        config(readRobot(parseToml(robotToml, robotFile.string()))),
        factory(PluginFactory::standardFolders()) {
    stopsWithCaller.emplace(given.session.stop, [this] { ending.request_stop(); });
    options.session.stop = ending.get_token();
    fillContainer(container, config, factory);
    connect();
  }

  /// Not by the constructor: what it tells may use the robot already.
  void start() {
    if (options.cycle > 0.0) thread = std::thread([this] { keepFresh(); });
  }

  ~Parts() {
    {
      const std::lock_guard lock(waiting);
      isEnding = true;
    }
    ending.request_stop();
    news.notify_all();
    if (thread.joinable()) thread.join();
  }

  // --- with `talking` held ---

  void connect() {
    session = std::make_unique<RobotSession>(options.session, robotToml);
    description = session->describe();
    newest = session->newest();
    isConnected = true;
    offset = {};
    isLockstep = false;
    lastServer = lastLocal = {};
    for (int i = 0; i < kFirstExchanges; ++i) offset.add(session->exchangeTime(options.clock));
    exchanged = options.clock();
  }

  void drop() {
    isConnected = false;
    session.reset();
  }

  void measureTime() {
    if (options.clock() - exchanged < kExchangePeriod) return;
    offset.add(session->exchangeTime(options.clock));
    exchanged = options.clock();
  }

  /// In our clock; never back while the server's does not go back either.
  Timestamp localStamp(Timestamp server) {
    if (!options.hasLocalStamps) return server;
    Timestamp local = offset.toLocal(server);
    if (lastServer && server >= *lastServer) local = std::max(local, lastLocal);
    lastServer = server;
    lastLocal = local;
    return local;
  }

  void fill(std::vector<Message> readings) {
    for (Message& reading : readings) reading.stamp = localStamp(reading.stamp);
    newest = session->newest();
    container.set(readings);
    {
      const std::lock_guard lock(waiting);
      ++updates;
    }
    news.notify_all();
  }

  template <class Action>
  void talk(Action action) {
    const std::lock_guard lock(talking);
    if (!session && !(options.reconnects && tryToConnect()))
      throw ConnectionLost("not connected to " + options.session.server());
    try {
      action();
    } catch (const ConnectionLost& error) {
      report(error.what());  // before it shows as not connected
      drop();
      pause = kFirstPause;
      nextAttempt = steady_clock::now();
      throw;
    } catch (const std::exception& error) {  // refused, or words that a feature refuses
      report(error.what());
      throw;
    } catch (...) {  // of the caller's clock, or of a plugin
      report("something was thrown that is no std::exception");
      throw;
    }
  }

  // --- without it ---

  /// Does something with the session; whatever goes wrong becomes trouble, is told, and thrown.
  template <class Action>
  void perform(Action action) {
    try {
      talk(action);
    } catch (...) {
      tell();
      throw;
    }
    tell();
  }

  /// Performs an action; false if it failed, for whoever looks at the trouble later.
  template <class Action>
  bool attempt(Action action) {
    try {
      perform(action);
      return true;
    } catch (...) {
      return false;
    }
  }

  /// Tells the owner what was reported. No lock is held meanwhile, and who comes while another one
  /// tells leaves it to that one, so whatever the owner does with locks of its own, nobody waits.
  void tell() {
    std::unique_lock lock(waiting);
    if (teller != std::thread::id()) return;
    teller = std::this_thread::get_id();
    while (!untold.empty()) {
      const std::string text = std::move(untold.front());
      untold.pop_front();
      lock.unlock();
      try {
        options.onTrouble(text);
      } catch (...) {  // it has no caller who could be told
      }
      lock.lock();
    }
    teller = {};
  }

  // --- with `talking` held ---

  bool tryToConnect() {
    if (steady_clock::now() < nextAttempt) return false;
    try {
      connect();
      report("");
      return true;
    } catch (const std::exception& error) {
      report(error.what());
      drop();
      nextAttempt = steady_clock::now() + seconds(pause);
      pause = std::min(2.0 * pause, kLongestPause);
      return false;
    }
  }

  /// Notes what went wrong, or "" for all is well, to be told later. What goes wrong in what the
  /// owner does while it is told something is not told again, else there would be no end.
  void report(const std::string& what) {
    const std::lock_guard lock(waiting);
    if (what == trouble || isEnding) return;
    trouble = what;
    if (!options.onTrouble || (!what.empty() && teller == std::this_thread::get_id())) return;
    untold.push_back(what.empty() ? "connected again to " + options.session.host : what);
    if (untold.size() > kMostUntold) untold.pop_front();
  }

  // --- the thread ---

  bool update() {
    return attempt([this] {
      measureTime();
      fill(session->update());
    });
  }

  void keepFresh() {
    auto due = steady_clock::now();
    while (true) {
      update();
      due = std::max(due + seconds(options.cycle), steady_clock::now());
      std::unique_lock lock(waiting);
      if (news.wait_until(lock, due, [this] { return isEnding; })) return;
    }
  }

  RemoteOptions options;
  std::string robotToml;
  RobotConfig config;
  PluginFactory factory;
  SensorContainer container;

  std::stop_source ending;  ///< ends the session
  std::optional<std::stop_callback<std::function<void()>>> stopsWithCaller;
  std::atomic<bool> isConnected{false};
  mutable std::mutex talking;  ///< over what follows: one conversation at a time
  std::unique_ptr<RobotSession> session;
  RobotDescription description;
  ClockOffset offset;
  Timestamp newest = 0;
  Timestamp exchanged = 0;
  std::optional<Timestamp> lastServer;
  Timestamp lastLocal = 0;
  bool isLockstep = false;
  double pause = kFirstPause;
  steady_clock::time_point nextAttempt;

  mutable std::mutex waiting;  ///< over what follows
  std::condition_variable news;
  std::string trouble;
  std::deque<std::string> untold;
  std::thread::id teller;  ///< thread that is in onTrouble; none: no thread
  std::uint64_t updates = 0;
  bool isEnding = false;
  std::thread thread;
};

RemoteRobot::RemoteRobot(const std::filesystem::path& robotFile, const RemoteOptions& options)
    : parts_(std::make_unique<Parts>(robotFile, options)) {
  parts_->start();
}

RemoteRobot::~RemoteRobot() = default;

SensorContainer& RemoteRobot::container() { return parts_->container; }

RobotDescription RemoteRobot::description() const {
  const std::lock_guard lock(parts_->talking);
  return parts_->description;
}

void RemoteRobot::setTranslationalVelocity(double metresPerSecond) {
  parts_->perform([&] { parts_->session->setTranslationalVelocity(metresPerSecond); });
}

void RemoteRobot::setRotationalVelocity(double radiansPerSecond) {
  parts_->perform([&] { parts_->session->setRotationalVelocity(radiansPerSecond); });
}

void RemoteRobot::setMotion(std::span<const double> command) {
  parts_->perform([&] { parts_->session->setMotion(command); });
}

void RemoteRobot::setManipulator(std::string_view manipulator, std::string_view state) {
  parts_->perform([&] { parts_->session->setManipulator(manipulator, state); });
}

void RemoteRobot::tellTeam(const std::string& text) {
  parts_->perform([&] { parts_->session->tellTeam(text); });
}

std::vector<TeamWords> RemoteRobot::hearTeam() {
  std::vector<TeamWords> talk;
  parts_->perform([&] { talk = parts_->session->hearTeam(); });
  return talk;
}

std::string RemoteRobot::game() {
  std::string game;
  parts_->perform([&] { game = parts_->session->game(); });
  return game;
}

bool RemoteRobot::say(const std::string& text) {
  return parts_->attempt([&] { parts_->session->say(text); });
}

bool RemoteRobot::update() { return parts_->update(); }

bool RemoteRobot::next(std::uint64_t cycles) {
  bool isThere = false;
  const bool isDone = parts_->attempt([&] {
    if (!parts_->isLockstep) parts_->session->setLockstep(true);
    parts_->isLockstep = true;
    auto readings = parts_->session->next(cycles);
    isThere = readings.has_value();
    if (isThere) parts_->fill(std::move(*readings));
  });
  return isDone && isThere;
}

bool RemoteRobot::waitForUpdate(double timeout) {
  if (std::isnan(timeout)) throw std::invalid_argument("the timeout is not a number");
  std::unique_lock lock(parts_->waiting);
  const std::uint64_t before = parts_->updates;
  return parts_->news.wait_for(lock, seconds(timeout), [&] { return parts_->updates > before; });
}

bool RemoteRobot::isConnected() const { return parts_->isConnected; }

std::string RemoteRobot::trouble() const {
  const std::lock_guard lock(parts_->waiting);
  return parts_->trouble;
}

std::vector<std::string> RemoteRobot::takeNews() {
  const std::lock_guard lock(parts_->talking);
  return parts_->session ? parts_->session->takeNews() : std::vector<std::string>{};
}

Timestamp RemoteRobot::newest() const {
  const std::lock_guard lock(parts_->talking);
  return parts_->newest;
}

ClockOffset RemoteRobot::clockOffset() const {
  const std::lock_guard lock(parts_->talking);
  return parts_->offset;
}

}  // namespace ortung

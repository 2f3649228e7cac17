#include "WorldKeeper.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "Request.hpp"

namespace ortung::server {
namespace {

constexpr Timestamp kNever = std::numeric_limits<Timestamp>::max();
constexpr Timestamp kLongestWait = 100'000;   // until it checks whether to go on [us]
constexpr Timestamp kMostBehind = 1'000'000;  // delay that the world tries to catch up [us]
// Limits of the orders that are executed although the next cycle is due.
constexpr std::size_t kOrdersOfLateCycle = 256;
constexpr Timestamp kTimeOfLateCycle = 2'000;  // [us]

}  // namespace

Timestamp wallTime() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

std::string currentErrorText() {
  try {
    throw;
  } catch (const ServeError& error) {
    return "ERR " + error.code() + " " + printable(error.what());
  } catch (const ConfigError& error) {
    return "ERR configuration " + printable(error.what());
  } catch (const PluginError& error) {
    return "ERR configuration " + printable(error.what());
  } catch (const std::invalid_argument& error) {
    return "ERR argument " + printable(error.what());
  } catch (const std::exception& error) {
    return "ERR internal " + printable(error.what());
  } catch (...) {  // commands of the board's host may throw anything
    return "ERR internal it threw no std::exception";
  }
}

WorldKeeper::WorldKeeper(ServedWorld& world, const BoardConfig& config,
                         std::function<void()> onCycle)
    : world_(world),
      config_(config),
      onCycle_(std::move(onCycle)),
      livePeriod_(world.livePeriod()),
      speed_(config.speed),
      isFree_(config.pace != Pace::kRealTime) {
  meetResidents();
  if (auto features = world_.truthFeatures(); !features.empty()) {
    truth_ = std::make_shared<RobotReadings>(0, "world", std::move(features));
    publishTruth();
  }
  clock_.set(world_.now(), wallTime(), 0.0);
}

WorldKeeper::~WorldKeeper() = default;

void WorldKeeper::give(ClientId client, Order order, Done done) {
  {
    const std::lock_guard lock(mutex_);
    std::deque<Given>& its = orders_[client];
    if (its.empty()) turns_.push_back(client);
    its.push_back({std::move(order), std::move(done)});
  }
  news_.notify_one();
}

void WorldKeeper::stop() {
  {
    const std::lock_guard lock(mutex_);
    isStopped_ = true;
  }
  news_.notify_one();
}

BoardStatistics WorldKeeper::statistics() const {
  return {cycles_, missed_, clientCount_, robotCount_};
}

// --- time

bool WorldKeeper::isLockstepReady() const {
  bool any = false;
  for (const auto& [id, client] : clients_) {
    if (client.isLockstep && client.cycles == 0) return false;
    any = any || client.isLockstep;
  }
  return any || config_.pace != Pace::kLockstep;
}

bool WorldKeeper::mayAdvance() const {
  if (!failure_.empty() || world_.isAtEnd() || !world_.isReady()) return false;
  return isPaused_ ? steps_ > 0 : isLockstepReady();
}

/// Returns the latest time that the clock may show before the next cycle, however late that is: one
/// cycle more. A live world's clock can't be held up.
Timestamp WorldKeeper::latest() const { return isLive() ? kNever : world_.now() + cycle_; }

void WorldKeeper::anchor(Timestamp wall) {
  anchorStamp_ = world_.now();
  anchorWall_ = wall;
  measuredWall_ = 0;  // time may have jumped
  const bool stands = isFree_ || isPaused_ || wasBlocked_;
  clock_.set(anchorStamp_, anchorWall_, stands ? 0.0 : speed_, latest());
}

/// Returns when the next cycle begins, in wall time; if that has passed, it begins at once.
Timestamp WorldKeeper::due() {
  if (!mayAdvance()) {
    if (!wasBlocked_) clock_.set(world_.now(), wallTime(), 0.0);
    wasBlocked_ = true;
    return kNever;
  }
  if (isLive()) return nextLook_;
  if (isFree_ || isPaused_) {
    if (std::exchange(wasBlocked_, false)) anchor(wallTime());
    return 0;
  }
  const auto behindAnchor = static_cast<double>(world_.now() - anchorStamp_) / speed_;
  const Timestamp regular = anchorWall_ + static_cast<Timestamp>(behindAnchor);
  const bool wasBlocked = std::exchange(wasBlocked_, false);
  const Timestamp now = wallTime();
  // Time that was lost while the world was blocked is not caught up, nor is more than a second.
  if (now - regular > (wasBlocked ? 0 : kMostBehind)) {
    if (!wasBlocked && cycle_ > 0)
      missed_ += static_cast<std::uint64_t>(static_cast<double>(now - regular) * speed_ /
                                            static_cast<double>(cycle_));
    anchor(now);
    return now;
  }
  if (wasBlocked) clock_.set(world_.now(), regular, speed_, latest());
  return regular;
}

void WorldKeeper::run(const std::function<bool()>& goesOn) {
  if (isLive())
    follow(wallTime() - livePeriod_);  // so the first look is due at once
  else
    anchor(wallTime());
  while (!isStopped_ && (!goesOn || goesOn())) {
    const Timestamp next = due();
    const Timestamp now = wallTime();
    if (execute(now >= next)) continue;
    if (now >= nextSeek_ && seekNext()) continue;
    if (now >= next) {
      cycle(next);
      continue;
    }
    if (wasBlocked_ || isPaused_) publishLate();
    const Timestamp rest = seeks_.empty() ? next - now : std::min(next, nextSeek_) - now;
    std::unique_lock lock(mutex_);
    if (!turns_.empty() || isStopped_) continue;
    news_.wait_for(lock, std::chrono::microseconds(std::min(rest, kLongestWait)));
  }
}

void WorldKeeper::runOnce() {
  while (execute(false) || seekNext()) {
  }
  const Timestamp next = due();
  if (wallTime() >= next) cycle(next);
}

/// Executes the next order, unless the world has waited long enough.
bool WorldKeeper::execute(bool isCycleDue) {
  Given given;
  {
    const std::lock_guard lock(mutex_);
    const bool isEnough = executed_ >= kOrdersOfLateCycle || spent_ >= kTimeOfLateCycle;
    if (turns_.empty() || (isCycleDue && isEnough)) return false;
    const auto its = orders_.find(turns_.front());
    turns_.pop_front();
    given = std::move(its->second.front());
    its->second.pop_front();
    if (its->second.empty())
      orders_.erase(its);
    else
      turns_.push_back(its->first);
  }
  const Timestamp begin = wallTime();
  execute(given);
  ++executed_;
  spent_ += wallTime() - begin;
  return true;
}

void WorldKeeper::execute(Given& given) {
  std::string text;
  try {
    std::optional<std::string> reply = given.order(*this, given.done);
    if (!reply) return meetResidents();
    text = std::move(*reply);
  } catch (...) {
    text = currentErrorText();
  }
  meetResidents();
  // In a paused world no cycle would report that something was moved by hand.
  if (wasBlocked_ || isPaused_)
    if (publishTruth() && onCycle_) onCycle_();
  if (given.done) given.done(std::move(text));
}

void WorldKeeper::cycle(Timestamp due) {
  const Timestamp begin = wallTime();
  const Timestamp stamp = world_.now();
  try {
    world_.step();
  } catch (const std::exception& error) {
    fail(error.what());
    return;
  }
  meetResidents();
  cycle_ = isLive() ? livePeriod_ : world_.now() - stamp;
  const double behind = static_cast<double>(begin - due) * speed_;
  if (!isFree_ && !isPaused_ && behind > static_cast<double>(cycle_)) ++missed_;
  for (const auto& [id, robot] : robots_) {
    robot.readings->publish(world_.readings(id));
    if (const auto wanted = robot.readings->takeWanted()) world_.want(id, *wanted);
  }
  if (isLive())
    follow(begin);
  else if (isFree_ || isPaused_)
    clock_.set(world_.now(), begin, 0.0);
  else
    clock_.permit(latest());
  publishTruth();
  measure(begin);
  executed_ = 0;
  spent_ = 0;
  ++cycles_;
  finishCycle();
  if (onCycle_) onCycle_();
}

/// @returns whether the world differs from what was published last
bool WorldKeeper::publishTruth() {
  if (!truth_) return false;
  const std::span<Message> truth = world_.truth();
  const bool isSame = std::equal(truth.begin(), truth.end(), told_.begin(), told_.end(),
                                 [](const Message& a, const Message& b) {
                                   return a.stamp == b.stamp && a.id == b.id && a.words == b.words;
                                 });
  if (isSame) return false;
  told_.assign(truth.begin(), truth.end());
  truth_->publish(truth);
  return true;
}

/// Publishes readings that become ready while the world is paused, when no cycle brings them.
void WorldKeeper::publishLate() {
  bool isNew = false;
  for (const auto& [id, robot] : robots_) {
    std::vector<Message> late = world_.lateReadings(id);
    isNew = isNew || !late.empty();
    if (!late.empty()) robot.readings->publish(late);
  }
  if (isNew && onCycle_) onCycle_();
}

void WorldKeeper::measure(Timestamp wall) {
  constexpr Timestamp kWindow = 1'000'000;  // [us]
  const Timestamp stamp = world_.now();
  if (wall - measuredWall_ < kWindow && stamp >= measuredStamp_) return;
  if (measuredWall_ > 0 && stamp >= measuredStamp_)
    achieved_ =
        static_cast<double>(stamp - measuredStamp_) / static_cast<double>(wall - measuredWall_);
  measuredWall_ = wall;
  measuredStamp_ = stamp;
}

std::string WorldKeeper::paceText() const {
  std::string text = " speed=" + shown(isFree_ ? 0.0 : speed_) + " achieved=" + shown(achieved_);
  if (const auto seed = world_.seed()) text += " seed=" + std::to_string(*seed);
  return text;
}

void WorldKeeper::finishCycle() {
  // Clients that asked for more cycles get those that there were.
  const bool isLast = world_.isAtEnd();
  for (auto& [id, client] : clients_) {
    if (!client.isLockstep || client.cycles == 0 || (--client.cycles > 0 && !isLast)) continue;
    client.cycles = 0;
    std::exchange(client.waiting, {})("");
  }
  if (steps_ == 0 || (--steps_ > 0 && !isLast)) return;
  steps_ = 0;
  std::exchange(stepsDone_, {})("OK STEP");
}

void WorldKeeper::fail(const std::string& why) {
  failure_ = why;
  if (config_.log) config_.log("the world can't go on: " + why);
  // Clients that wait for cycles get an error.
  const std::string text = "ERR failed " + printable(failure_);
  for (auto& [id, client] : clients_) {
    client.cycles = 0;
    if (client.waiting) std::exchange(client.waiting, {})(text);
  }
  steps_ = 0;
  if (stepsDone_) std::exchange(stepsDone_, {})(text);
}

/// Sets the clock to that of a live world, and the time of the next look at it.
void WorldKeeper::follow(Timestamp looked) {
  wasBlocked_ = false;
  clock_.set(world_.now(), wallTime(), 1.0);
  nextLook_ = looked + livePeriod_;
}

void WorldKeeper::refuseIfLive(const char* what) const {
  if (isLive())
    throw ServeError("live", std::string("this is a running robot: its time can't be ") + what);
}

void WorldKeeper::pause() {
  refuseIfLive("paused");
  isPaused_ = true;
  clock_.set(world_.now(), wallTime(), 0.0);  // it stands before the reply says so
}

void WorldKeeper::setSpeed(double speed) {
  refuseIfLive("made faster or slower");
  isFree_ = speed == 0.0;
  if (!isFree_) speed_ = speed;
  anchor(wallTime());
}

void WorldKeeper::resume() {
  refuseIfLive("paused");
  isPaused_ = false;
  wasBlocked_ = true;  // the clock was stopped
}

void WorldKeeper::step(std::uint64_t cycles, Done done) {
  refuseIfLive("stepped");
  if (!isPaused_) throw ServeError("state", "STEP is for a simulation that is paused");
  if (steps_ > 0) throw ServeError("state", "there are steps under way already");
  if (!failure_.empty() || world_.isAtEnd()) throw ServeError("end", "there is nothing to come");
  steps_ = cycles;
  stepsDone_ = std::move(done);
}

void WorldKeeper::reset(std::optional<std::uint64_t> seed) {
  refuseIfLive("started over");
  world_.reset(seed);
  failure_.clear();
  score = {};
  for (const auto& [id, robot] : robots_) robot.readings->forget();
  publishTruth();
  anchor(wallTime());
}

void WorldKeeper::seek(ClientId id, Timestamp stamp, std::shared_ptr<Question> question,
                       Done done) {
  refuseIfLive("wound back or forward");
  if (question->isWithdrawn()) return;
  const auto its =
      std::find_if(seeks_.begin(), seeks_.end(), [&](const Seek& one) { return one.client == id; });
  Seek wanted{id, stamp, std::move(question), std::move(done)};
  if (its == seeks_.end())
    seeks_.push_back(std::move(wanted));
  else
    *its = std::move(wanted);  // that one was withdrawn, since the client's lines wait for it
}

bool WorldKeeper::seekNext() {
  if (seeks_.empty()) return false;
  Seek next = std::move(seeks_.front());
  seeks_.pop_front();
  if (!next.question->begin()) return true;
  const Timestamp begin = wallTime();
  std::string text;
  try {
    seek(next.stamp);
    text = "OK SEEK now=" + std::to_string(world_.now());
  } catch (...) {
    text = currentErrorText();
  }
  const Timestamp end = wallTime();
  const double pause = static_cast<double>(end - begin) * (1.0 / config_.limits.seekShare - 1.0);
  nextSeek_ = end + static_cast<Timestamp>(pause);
  next.done(std::move(text));
  return true;
}

void WorldKeeper::seek(Timestamp stamp) {
  world_.seek(stamp);
  for (const auto& [id, robot] : robots_) {
    robot.readings->forget();
    robot.readings->publish(world_.readings(id));
  }
  publishTruth();
  anchor(wallTime());
  if (onCycle_) onCycle_();
}

std::string WorldKeeper::stateText() const {
  if (!failure_.empty()) return "failed";
  if (world_.isAtEnd()) return "ended";
  if (isPaused_) return "paused";
  return world_.isReady() && isLockstepReady() ? "running" : "waiting";
}

// --- lockstep

void WorldKeeper::setLockstep(ClientId id, bool isLockstep) {
  if (isLockstep) refuseIfLive("held up");
  Client& its = client(id);
  its.isLockstep = isLockstep;
  if (!isLockstep && its.waiting) {
    its.cycles = 0;
    std::exchange(its.waiting, {})("ERR state lockstep was switched off");
  }
}

void WorldKeeper::next(ClientId id, std::uint64_t cycles, Done done) {
  Client& its = client(id);
  if (!its.isLockstep) throw ServeError("state", "NEXT is for clients in lockstep: LOCKSTEP on");
  if (its.cycles > 0) throw ServeError("state", "a NEXT is under way already");
  if (!failure_.empty()) throw ServeError("failed", failure_);
  if (world_.isAtEnd()) throw ServeError("end", "there is nothing more to come");
  its.cycles = cycles;
  its.waiting = std::move(done);
}

}  // namespace ortung::server

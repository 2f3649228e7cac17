#include "ortung/emulators/EmulatorRun.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>

namespace ortung {
namespace {

constexpr Timestamp kLongestWait = 20'000;  ///< longest wait between two rounds [us]
constexpr int kFlood = 1000;
constexpr std::uint64_t kStream = 0x6c696e65;

Timestamp realTime() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

bool differ(std::optional<int> own, std::optional<int> other) {
  return own && other && *own != *other;
}

}  // namespace

EmulatorRun::EmulatorRun(std::vector<Line> lines, Source& source, const Config& config)
    : lines_(std::move(lines)),
      states_(lines_.size()),
      reader_(source),
      config_(config),
      random_(config.seed, kStream),
      switchedOn_(realTime()) {
  isAtEnd_ = !reader_.next(frame_);
  if (!isAtEnd_) first_ = frame_.front().stamp;
}

Timestamp EmulatorRun::now() const {
  return static_cast<Timestamp>(static_cast<double>(realTime() - switchedOn_) * config_.speed);
}

bool EmulatorRun::everybodyMeasures() const {
  return std::all_of(lines_.begin(), lines_.end(),
                     [](const Line& line) { return line.device->isMeasuring(); });
}

void EmulatorRun::run(const std::function<bool()>& goesOn) {
  // Telegrams that were sent at the end still arrive.
  constexpr Timestamp kAfterwards = 500'000;
  Timestamp end = 0;
  while (goesOn()) {
    const Timestamp time = now();
    if (!beganAt_ && (!config_.waits || everybodyMeasures())) beganAt_ = time;
    if (beganAt_) feed(time);
    for (std::size_t i = 0; i < lines_.size(); ++i) exchange(i, time);
    if (isAtEnd_ && end == 0) end = realTime() + kAfterwards;
    if (isAtEnd_ && realTime() > end) return;
    wait(time);
  }
}

void EmulatorRun::feed(Timestamp now) {
  while (!isAtEnd_ && frame_.front().stamp - first_ <= now - *beganAt_) {
    const Timestamp then = frame_.front().stamp - first_ + *beganAt_;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (const Message& message : frame_) sense(i, message, then);
    isAtEnd_ = !reader_.next(frame_);
  }
}

bool EmulatorRun::has(std::size_t line, EmulatorFault::Kind kind, Timestamp now) const {
  if (!beganAt_) return false;
  const auto& faults = lines_[line].faults;
  return std::any_of(faults.begin(), faults.end(), [&](const EmulatorFault& fault) {
    return fault.kind == kind && fault.isOn(now - *beganAt_);
  });
}

void EmulatorRun::sense(std::size_t line, const Message& message, Timestamp now) {
  std::vector<Message>& frozen = states_[line].frozen;
  const auto last = std::find_if(frozen.begin(), frozen.end(),
                                 [&](const Message& one) { return one.id == message.id; });
  EmulatedDevice& device = *lines_[line].device;
  if (has(line, EmulatorFault::Kind::kFreeze, now) && last != frozen.end()) {
    device.sense(*last, now);
    return;
  }
  if (last == frozen.end())
    frozen.push_back(message);
  else
    *last = message;
  const int times = has(line, EmulatorFault::Kind::kFlood, now) ? kFlood : 1;
  for (int i = 0; i < times; ++i) device.sense(message, now + 1000 * i);
}

void EmulatorRun::switchFaults(std::size_t line, Timestamp now) {
  Line& one = lines_[line];
  State& state = states_[line];
  const bool isOut = has(line, EmulatorFault::Kind::kUnplug, now);
  if (isOut && !one.endpoint->name().empty()) one.endpoint->unplug();
  if (!isOut && one.endpoint->name().empty()) one.endpoint->plug();
  for (const EmulatorFault& fault : one.faults) {
    if (fault.kind != EmulatorFault::Kind::kJump || state.hasJumped || !beganAt_) continue;
    if (!fault.isOn(now - *beganAt_)) continue;
    one.device->clock.offset += fault.value;
    state.hasJumped = true;
  }
}

void EmulatorRun::exchange(std::size_t line, Timestamp now) {
  switchFaults(line, now);
  Line& one = lines_[line];
  std::string bytes;
  one.endpoint->read(bytes);
  if (differ(one.device->baud(), one.endpoint->baud())) bytes = atWrongSpeed(bytes, random_);
  if (!bytes.empty()) one.device->receive(bytes, now);
  for (auto& [telegram, speed] : one.device->takeOutput(now)) {
    bool& isOdd = states_[line].isOdd;
    isOdd = !isOdd;
    if (has(line, EmulatorFault::Kind::kSilent, now)) continue;
    for (const auto kind : {EmulatorFault::Kind::kGarbage, EmulatorFault::Kind::kHalf})
      if (has(line, kind, now)) telegram = damaged(telegram, kind, isOdd, random_);
    if (differ(speed, one.endpoint->baud())) telegram = atWrongSpeed(telegram, random_);
    one.endpoint->write(telegram);
  }
}

/// Waits until the next reading or telegram is due, or a driver sends something.
void EmulatorRun::wait(Timestamp now) const {
  Timestamp until = now + kLongestWait;
  if (beganAt_ && !isAtEnd_) until = std::min(until, frame_.front().stamp - first_ + *beganAt_);
  std::vector<pollfd> ends;
  for (const Line& line : lines_) {
    if (const auto due = line.device->due()) until = std::min(until, *due);
    if (line.endpoint->descriptor() >= 0) ends.push_back({line.endpoint->descriptor(), POLLIN, 0});
  }
  const double left = static_cast<double>(until - now) / config_.speed;
  const auto nanoseconds = static_cast<long>(std::clamp(left, 0.0, 20'000.0) * 1000.0);
  const timespec time{0, nanoseconds};
  ::ppoll(ends.data(), ends.size(), &time, nullptr);
}

}  // namespace ortung

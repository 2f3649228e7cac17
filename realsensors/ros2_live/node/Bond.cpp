#include "Bond.hpp"

#include <array>
#include <cstdio>
#include <random>

#include "NodeMessages.hpp"

namespace ortung::ros2 {
namespace {

/// How long it says that it has ended, since a message may be lost.
constexpr std::chrono::milliseconds kFarewell{500};

/// Random words in the form of a UUID, by which sides are told apart.
std::string newInstance() {
  std::random_device random;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%08x-%04x-%04x-%04x-%08x%04x", random(),
                random() & 0xffffU, random() & 0xffffU, random() & 0xffffU, random(),
                random() & 0xffffU);
  return text.data();
}

}  // namespace

Bond::Bond(std::string id, double period) : id_(std::move(id)), period_(period) {}

void Bond::sendBy(Participant::Sender send) {
  const std::lock_guard lock(mutex_);
  send_ = std::move(send);
}

void Bond::connect(Participant& node) {
  if (period_.count() <= 0.0) return;
  sendBy(node.publish("/bond", BondStatus::kType, Qos::kDefault));
  node.subscribe("/bond", BondStatus::kType, Qos::kDefault,
                 [this](std::string_view cdr) { hear(cdr); });
}

void Bond::say(Clock::time_point at) {
  next_ = at + std::chrono::duration_cast<Clock::duration>(period_);
  if (!send_) return;
  const std::chrono::duration<float> timeout = kTimeout;
  send_(cdrOf(BondStatus{{timeOfDay(), ""},
                         id_,
                         instance_,
                         isActive_,
                         timeout.count(),
                         static_cast<float>(period_.count())}));
}

void Bond::start(Clock::time_point at) {
  const std::lock_guard lock(mutex_);
  if (isActive_) return;
  isActive_ = true;
  instance_ = newInstance();
  say(at);
}

void Bond::stop(Clock::time_point at) {
  const std::lock_guard lock(mutex_);
  if (!isActive_) return;
  isActive_ = false;
  until_ = at + kFarewell;
  say(at);
}

void Bond::tick(Clock::time_point at) {
  const std::lock_guard lock(mutex_);
  if (instance_.empty() || at < next_ || (!isActive_ && at > until_)) return;
  say(at);
}

void Bond::hear(std::string_view cdr, Clock::time_point at) {
  BondStatus said;
  readCdr(cdr, said);
  const std::lock_guard lock(mutex_);
  if (said.id != id_ || said.instance == instance_ || said.isActive || !isActive_) return;
  isActive_ = false;
  until_ = at + kFarewell;
  say(at);
}

}  // namespace ortung::ros2

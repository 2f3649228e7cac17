#include "ortung/devices/Merger.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace ortung {
namespace {

constexpr std::size_t kMostWaiting = 1024;  ///< greatest number of waiting readings of a device

}  // namespace

bool Merger::Waiting::operator<(const Waiting& other) const {
  return std::tie(stamp, device, number) < std::tie(other.stamp, other.device, other.number);
}

Merger::Merger(std::size_t devices, double wait) : lanes_(devices), wait_(fromSeconds(wait)) {}

bool Merger::push(std::size_t device, Message message) {
  Lane& lane = lanes_[device];
  lane.newest = std::max(message.stamp, lane.newest.value_or(message.stamp));
  if (passed_ && message.stamp < *passed_) {
    ++lane.late;
    return false;
  }
  if (lane.waiting == kMostWaiting) {  // they are not taken: the oldest one is the least useful
    const auto oldest = std::find_if(waiting_.begin(), waiting_.end(),
                                     [&](const Waiting& one) { return one.device == device; });
    waiting_.erase(oldest);
    --lane.waiting;
    ++lane.lost;
  }
  const Timestamp stamp = message.stamp;
  waiting_.insert({stamp, device, pushed_++, std::move(message)});
  ++lane.waiting;
  return true;
}

std::optional<Message> Merger::pop(Timestamp now) {
  if (waiting_.empty()) return std::nullopt;
  Timestamp complete = std::numeric_limits<Timestamp>::max();
  for (const Lane& lane : lanes_)
    if (lane.isAwaited && lane.newest) complete = std::min(complete, *lane.newest);
  const auto first = waiting_.begin();
  if (first->stamp > complete && now < first->stamp + wait_) return std::nullopt;
  Message message = std::move(first->message);
  --lanes_[first->device].waiting;
  waiting_.erase(first);
  passed_ = message.stamp;
  return message;
}

std::optional<Timestamp> Merger::due() const {
  if (waiting_.empty()) return std::nullopt;
  return waiting_.begin()->stamp + wait_;
}

}  // namespace ortung

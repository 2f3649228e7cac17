#include "Subscriptions.hpp"

#include <utility>

#include "Caller.hpp"
#include "SentReadings.hpp"

namespace ortung::server {

void Subscriptions::begin(Caller& caller, RobotId robot, const Wish& wish) {
  if (isEmpty()) caller.host().countSubscribers(1);
  subscribed_[robot] = {wish};
}

/// Ends a subscription. Readings of another client's robot are dropped: it may leave the field at
/// any time.
void Subscriptions::end(Caller& caller, RobotId robot) {
  if (subscribed_.erase(robot) == 0) return;
  ClientRobots& robots = caller.client().robots;
  if (!robots.owns(robot)) robots.forget(robot);
  if (isEmpty()) caller.host().countSubscribers(-1);
}

void Subscriptions::endAll(Caller& caller) {
  while (!isEmpty()) end(caller, subscribed_.begin()->first);
}

void Subscriptions::got(Caller& caller, RobotId robot) {
  const auto found = subscribed_.find(robot);
  if (found == subscribed_.end() || found->second.unread == 0) return;
  --found->second.unread;
  // A paused world has no next cycle that would send the update.
  if (std::exchange(found->second.isOwed, false)) send(caller, robot, found->second);
}

void Subscriptions::onCycle(Caller& caller) {
  // Sending may end all subscriptions: a client that does not read is dismissed.
  for (auto next = subscribed_.begin(); next != subscribed_.end();) {
    const RobotId robot = next->first;
    if (!send(caller, robot, next->second)) {
      caller.tell("REMOVE robot=" + std::to_string(robot));
      caller.client().robots.forget(robot);
      end(caller, robot);
    }
    next = subscribed_.upper_bound(robot);
  }
}

/// @returns false if the robot has left the field
bool Subscriptions::send(Caller& caller, RobotId robot, Subscription& subscription) {
  const ClientRobots::View* view = caller.client().robots.view(robot);
  if (view != nullptr && view->readings->isRetired()) return false;
  const Timestamp period = subscription.wish.period;
  const Timestamp now = caller.host().keeper.clock().at(wallTime());
  if (now < subscription.due && subscription.due - now <= period) return true;
  // A client that reads too slowly gets the newest readings less often.
  constexpr std::size_t kBehind = 64u << 10;
  const std::int64_t ahead = subscription.wish.ahead;
  subscription.isOwed = ahead > 0 && subscription.unread >= ahead;
  if (subscription.isOwed || caller.outlet().outstanding() > kBehind) return true;
  subscription.due += period;
  // This was the first update, or the world has been reset.
  if (subscription.due < now || subscription.due - now > period) subscription.due = now + period;
  ++subscription.unread;
  sendReadings(caller, "*", "UPDATE", robot, subscription.wish.choice);
  return true;
}

}  // namespace ortung::server

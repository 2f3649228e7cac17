#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "RobotReadings.hpp"
#include "ortung/base/Time.hpp"

namespace ortung::server {

class Caller;

/// What a client has subscribed to: a robot's readings, as the world goes on. Each call is told
/// whose subscriptions these are.
class Subscriptions {
 public:
  struct Wish {
    Choice choice;
    Timestamp period = 0;    ///< least time between two updates [us]; 0: each cycle
    std::int64_t ahead = 0;  ///< updates that may be on their way; 0: any number
  };

  bool isEmpty() const { return subscribed_.empty(); }
  bool contains(RobotId robot) const { return subscribed_.contains(robot); }
  std::size_t size() const { return subscribed_.size(); }
  void begin(Caller& caller, RobotId robot, const Wish& wish);
  void end(Caller& caller, RobotId robot);
  void endAll(Caller& caller);
  /// The client has read an update.
  void got(Caller& caller, RobotId robot);
  /// A cycle has ended: sends what is due.
  void onCycle(Caller& caller);

 private:
  struct Subscription {
    Wish wish;
    Timestamp due = 0;
    std::int64_t unread = 0;  ///< updates that the client has not acknowledged by GOT
    bool isOwed = false;      ///< something newer waits for that
  };
  static bool send(Caller& caller, RobotId robot, Subscription& subscription);

  std::map<RobotId, Subscription> subscribed_;
};

}  // namespace ortung::server

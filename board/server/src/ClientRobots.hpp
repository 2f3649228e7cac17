#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "RobotReadings.hpp"

namespace ortung::server {

/// The robots of one client, and what it was sent of them and of others that it looks at.
class ClientRobots {
 public:
  struct View {
    std::shared_ptr<RobotReadings> readings;
    std::vector<std::uint64_t> sent = {};  ///< see RobotReadings::write()
  };

  bool owns(RobotId robot) const { return owned_.contains(robot); }
  /// The lowest of its own; 0: it has none.
  RobotId first() const { return owned_.empty() ? 0 : *owned_.begin(); }
  void add(const std::shared_ptr<RobotReadings>& readings);
  void remove(RobotId robot);

  /// Looks at a robot. What was sent of it before is remembered.
  void watch(RobotId robot, const std::shared_ptr<RobotReadings>& readings);
  void forget(RobotId robot) { views_.erase(robot); }
  /// @returns null if it does not look at it
  View* view(RobotId robot);

 private:
  std::set<RobotId> owned_;
  std::map<RobotId, View> views_;
};

}  // namespace ortung::server

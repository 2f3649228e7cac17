#include "ClientRobots.hpp"

namespace ortung::server {

void ClientRobots::add(const std::shared_ptr<RobotReadings>& readings) {
  owned_.insert(readings->robot());
  watch(readings->robot(), readings);
}

void ClientRobots::remove(RobotId robot) {
  owned_.erase(robot);
  views_.erase(robot);
}

void ClientRobots::watch(RobotId robot, const std::shared_ptr<RobotReadings>& readings) {
  views_[robot].readings = readings;
}

ClientRobots::View* ClientRobots::view(RobotId robot) {
  const auto found = views_.find(robot);
  return found == views_.end() ? nullptr : &found->second;
}

}  // namespace ortung::server

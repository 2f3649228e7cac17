#include "LiveRequests.hpp"

#include <stdexcept>
#include <utility>

#include "NodeMessages.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/ros2/Messages.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {

void LiveRequests::takePose(std::string_view cdr) {
  PoseWithCovarianceStamped told;
  readCdr(cdr, told);
  if (!told.header.frame.empty() && told.header.frame != mapFrame_)
    throw std::invalid_argument("a pose in '" + told.header.frame + "', expected '" + mapFrame_ +
                                "'");
  const InitialPose wanted{toPose2(told.pose), toPlane(told.covariance)};
  if (!isPlausible(wanted.pose))
    throw std::invalid_argument("a pose that is no number, or beyond 1000 km");
  const std::lock_guard lock(mutex_);
  asked_.pose = wanted;
  asked_.relocalizes = false;  // what was asked last counts
}

void LiveRequests::goTo(const std::string& floor) {
  const std::lock_guard lock(mutex_);
  asked_.floor = floor;
}

void LiveRequests::relocalize() {
  const std::lock_guard lock(mutex_);
  asked_.relocalizes = true;
  asked_.pose.reset();
}

void LiveRequests::tellNow() {
  const std::lock_guard lock(mutex_);
  asked_.tellsNow = true;
}

void LiveRequests::configure() {
  const std::lock_guard lock(mutex_);
  asked_.isConfigured = true;
}

LiveRequests::Asked LiveRequests::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(asked_, {});
}

void LiveRequests::serve(Participant& node) {
  node.subscribe("initialpose", PoseWithCovarianceStamped::kType, Qos::kDefault,
                 [this](std::string_view cdr) { takePose(cdr); });
  node.serve("set_initial_pose", "nav2_msgs/srv/SetInitialPose", [this](std::string_view cdr) {
    takePose(cdr);
    return cdrOf(Nothing());
  });
  node.serve("reinitialize_global_localization", "std_srvs/srv/Empty", [this](std::string_view) {
    relocalize();
    return cdrOf(Nothing());
  });
  node.serve("request_nomotion_update", "std_srvs/srv/Empty", [this](std::string_view) {
    tellNow();
    return cdrOf(Nothing());
  });
}

}  // namespace ortung::ros2

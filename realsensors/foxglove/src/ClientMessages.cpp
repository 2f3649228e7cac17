#include "ClientMessages.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "ortung/base/Angles.hpp"
#include "ortung/ros2/Messages.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::foxglove {
namespace {

using nlohmann::json;

constexpr double kFarthest = 1e6;  ///< greatest coordinate [m]
constexpr double kFastest = 1e3;   ///< greatest velocity [m/s, rad/s]
constexpr double kLeastSigma =
    0.01;  ///< least sigma of a place [m]: a covariance of zeros says nothing
constexpr double kMostSigma = 100.0;  ///< greatest sigma of a place [m]

/// Returns the names of a message's type: ROS 1 leaves "msg" out, and so do some JSON clients.
bool isType(const std::string& name, std::string_view type) {
  std::string shorter(type);
  const std::size_t at = shorter.find("/msg/");
  shorter.replace(at, 5, "/");
  return name == type || name == shorter;
}

/// Reads numbers of a JSON object; what is missing is 0, as in ROS's own JSON.
class Numbers {
 public:
  explicit Numbers(const json& object) : object_(object) {}
  /// Returns a number by its path, as "/pose/pose/position/x".
  double operator()(const std::string& path) {
    const json::json_pointer pointer(path);
    if (!object_.contains(pointer)) return 0.0;
    const json& value = object_.at(pointer);
    if (!value.is_number()) isFine_ = false;
    return value.is_number() ? value.get<double>() : 0.0;
  }
  bool isFine() const { return isFine_; }

 private:
  const json& object_;
  bool isFine_ = true;
};

ros2::PoseWithCovarianceStamped poseOf(const json& object, bool& isFine) {
  ros2::PoseWithCovarianceStamped pose;
  Numbers number(object);
  const json::json_pointer frame("/header/frame_id");
  if (object.contains(frame) && object.at(frame).is_string())
    pose.header.frame = object.at(frame).get<std::string>();
  const std::string at = "/pose/pose/position/", turned = "/pose/pose/orientation/";
  pose.pose.position = {number(at + "x"), number(at + "y"), number(at + "z")};
  pose.pose.orientation = {number(turned + "x"), number(turned + "y"), number(turned + "z"),
                           number(turned + "w")};
  for (const std::size_t i : {0U, 7U, 35U})
    pose.covariance[i] = number("/pose/covariance/" + std::to_string(i));
  isFine = number.isFine();
  return pose;
}

ros2::Twist twistOf(const json& object, const std::string& path, bool& isFine) {
  Numbers number(object);
  ros2::Twist twist;
  twist.linear.x = number(path + "/linear/x");
  twist.linear.y = number(path + "/linear/y");
  twist.angular.z = number(path + "/angular/z");
  isFine = number.isFine();
  return twist;
}

bool isWithin(double value, double most) { return std::abs(value) <= most; }  // false for NaN

std::optional<std::string> poseRequest(const ros2::PoseWithCovarianceStamped& message,
                                       std::string& why) {
  std::string frame = message.header.frame;
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
  if (!frame.empty() && frame != "map") {
    why = "the pose is in the frame '" + frame.substr(0, 40) + "', expected map";
    return std::nullopt;
  }
  const Pose2 at = ros2::toPose2(message.pose);
  if (!isWithin(at.x, kFarthest) || !isWithin(at.y, kFarthest) || !std::isfinite(at.theta)) {
    why = "the pose is out of bounds, expected finite numbers and a rotation";
    return std::nullopt;
  }
  std::ostringstream request;
  request.precision(9);
  request << "LOCALIZE x_m=" << at.x << " y_m=" << at.y << " theta_deg=" << degrees(at.theta);
  const double sigma = std::sqrt(0.5 * (message.covariance[0] + message.covariance[7]));
  const double sigmaTurn = degrees(std::sqrt(message.covariance[35]));
  if (sigma >= kLeastSigma && sigma <= kMostSigma) request << " sigma_m=" << sigma;
  if (sigmaTurn >= 0.1 && sigmaTurn <= 180.0) request << " sigma_deg=" << sigmaTurn;
  return request.str();
}

std::optional<std::string> velocityRequest(const ros2::Twist& twist, std::string& why) {
  if (!isWithin(twist.linear.x, kFastest) || !isWithin(twist.angular.z, kFastest)) {
    why = "the velocity is out of bounds, expected finite numbers";
    return std::nullopt;
  }
  if (!(std::abs(twist.linear.y) < 1e-6)) {
    why = "the velocity is sideways (linear.y), which can't be told: expected 0";
    return std::nullopt;
  }
  std::ostringstream request;
  request.precision(9);
  request << "VELOCITY v_m_s=" << twist.linear.x << " w_rad_s=" << twist.angular.z;
  return request.str();
}

bool isStamped(const ClientChannel& channel) {
  return isType(channel.type, ros2::TwistStamped::kType);
}

std::optional<std::string> requestOfJson(const ClientChannel& channel, std::string_view message,
                                         std::string& why) {
  constexpr std::size_t kDeepest = 8;
  const auto isShallow = [](int depth, json::parse_event_t, json&) {
    return depth <= static_cast<int>(kDeepest);
  };
  const json object = json::parse(message, isShallow, false);
  if (!object.is_object()) {
    why = "found a message that is no JSON object, expected one";
    return std::nullopt;
  }
  bool isFine = false;
  if (wishOf(channel.topic) == ClientWish::kPose) {
    const auto pose = poseOf(object, isFine);
    if (isFine) return poseRequest(pose, why);
  } else {
    const auto twist = twistOf(object, isStamped(channel) ? "/twist" : "", isFine);
    if (isFine) return velocityRequest(twist, why);
  }
  why = "found something else where a number belongs";
  return std::nullopt;
}

std::optional<std::string> requestOfCdr(const ClientChannel& channel, std::string_view message,
                                        std::string& why) {
  if (wishOf(channel.topic) == ClientWish::kPose) {
    const auto pose = ros2::fromCdr<ros2::PoseWithCovarianceStamped>(message, why);
    return pose ? poseRequest(*pose, why) : std::nullopt;
  }
  if (isStamped(channel)) {
    const auto twist = ros2::fromCdr<ros2::TwistStamped>(message, why);
    return twist ? velocityRequest(twist->twist, why) : std::nullopt;
  }
  const auto twist = ros2::fromCdr<ros2::Twist>(message, why);
  return twist ? velocityRequest(*twist, why) : std::nullopt;
}

}  // namespace

std::optional<ClientWish> wishOf(const std::string& topic) {
  const std::string last = topic.substr(topic.rfind('/') + 1);
  if (last == "initialpose") return ClientWish::kPose;
  if (last == "cmd_vel") return ClientWish::kVelocity;
  return std::nullopt;
}

std::string robotOf(const std::string& topic) {
  const std::size_t end = topic.rfind('/');
  if (end == topic.npos || end == 0) return "";
  const std::size_t begin = topic.front() == '/' ? 1 : 0;
  return topic.substr(begin, end - begin);
}

std::string faultOf(const ClientChannel& channel) {
  const auto wish = wishOf(channel.topic);
  if (!wish)
    return "nothing here listens to '" + channel.topic.substr(0, 80) +
           "', expected initialpose or cmd_vel, perhaps behind a robot's name";
  if (channel.encoding != "json" && channel.encoding != "cdr")
    return "found the encoding '" + channel.encoding.substr(0, 40) + "', expected json or cdr";
  const bool isPose = *wish == ClientWish::kPose;
  const bool isRight = isPose ? isType(channel.type, ros2::PoseWithCovarianceStamped::kType)
                              : isType(channel.type, ros2::Twist::kType) || isStamped(channel);
  if (isRight) return "";
  return "found the type '" + channel.type.substr(0, 80) + "', expected " +
         std::string(isPose ? ros2::PoseWithCovarianceStamped::kType : ros2::Twist::kType);
}

std::optional<std::string> requestOf(const ClientChannel& channel, std::string_view message,
                                     std::string& why) {
  return channel.encoding == "json" ? requestOfJson(channel, message, why)
                                    : requestOfCdr(channel, message, why);
}

}  // namespace ortung::foxglove

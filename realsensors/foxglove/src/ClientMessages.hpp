#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ortung::foxglove {

/// A channel that a client has announced, to publish on it.
struct ClientChannel {
  std::string topic;
  std::string encoding;  ///< "json" or "cdr"
  std::string type;      ///< type of its messages: "geometry_msgs/msg/Twist"
};

/// What a client can tell a robot.
enum class ClientWish { kPose, kVelocity };

/// Returns what a channel is for, by the last word of its topic: "initialpose" or "cmd_vel".
std::optional<ClientWish> wishOf(const std::string& topic);
/// Returns the robot that a topic names: "bob" of "/bob/cmd_vel", "" of "/cmd_vel".
std::string robotOf(const std::string& topic);

/// Returns what is wrong with a channel; "": nothing.
std::string faultOf(const ClientChannel& channel);

/// Returns the request to the message board that a message stands for, without the robot:
/// "LOCALIZE x_m=1 y_m=2 theta_deg=90 sigma_m=0.5 sigma_deg=15" or "VELOCITY v_m_s=0.3 w_rad_s=0".
/// @param channel one without a fault @param message not trusted
/// @param why gets what is wrong if there is none
std::optional<std::string> requestOf(const ClientChannel& channel, std::string_view message,
                                     std::string& why);

}  // namespace ortung::foxglove

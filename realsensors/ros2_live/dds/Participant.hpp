#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "RosNames.hpp"

namespace ortung::ros2 {

/// Quality of service of a topic, as profiles of ROS 2 have it.
enum class Qos : std::uint8_t {
  kDefault,  ///< reliable, volatile, the last 10
  kSensor,   ///< best effort, volatile, the last 10
  kLatched,  ///< reliable, the last one also for those who come later
};

/// What a release of ROS has on the wire.
enum class Distro : std::uint8_t {
  kHumble,  ///< identifiers of 24 bytes
  kJazzy,   ///< of 16, and endpoints tell the hash of their type, since Iron
};

/// The names of releases that options take.
inline const std::vector<std::string> kReleases = {"humble", "iron",    "jazzy",
                                                   "kilted", "lyrical", "rolling"};
/// The release whose environment was sourced (ROS_DISTRO), or humble.
std::string releaseHere();
/// What a release has on the wire; one that is not known is a newer one.
Distro distroOf(std::string_view release);

/// A node of ROS 2 on DDS alone: topics, types and quality of service as rmw_fastrtps has them,
/// over UDP only, since shared memory of different versions does not go together. Publishing never
/// blocks for a reader. Thread-safe.
class Participant {
 public:
  struct Options {
    RosNames names;            ///< of the node, and of its topics and services
    std::uint32_t domain = 0;  ///< ROS_DOMAIN_ID
    bool isLocal = false;      ///< whether it talks on this machine only
    Distro distro = Distro::kHumble;
    /// Reads domain and range from the environment: ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY,
    /// ROS_AUTOMATIC_DISCOVERY_RANGE. @throws std::runtime_error naming a variable that is no such
    void readEnvironment();
  };
  /// Gets the bytes of a message (CDR with its head), which are valid during the call, on a thread
  /// of DDS. A message for which it throws is counted as refused.
  using Taker = std::function<void(std::string_view cdr)>;
  using Sender = std::function<void(std::string_view cdr)>;
  /// Answers a request of a service, both as bytes of CDR.
  using Handler = std::function<std::string(std::string_view cdr)>;

  /// @throws std::runtime_error if DDS can't begin
  explicit Participant(const Options& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Reads a topic. @param topic as a node names it: "scan", "/tf" @param type
  /// "sensor_msgs/msg/LaserScan"
  /// @throws std::runtime_error
  void subscribe(const std::string& topic, std::string_view type, Qos qos, Taker taker);
  /// Offers a topic. @return what sends a message; valid as long as this
  /// @throws std::runtime_error
  Sender publish(const std::string& topic, std::string_view type, Qos qos);
  /// The whole name of a topic or service of this node.
  std::string wholeName(const std::string& name) const;
  /// Whether somebody reads a topic that this offers.
  bool isHeard(const std::string& topic) const;
  /// Offers a service as rmw_fastrtps does, which tells in the head of a DDS message whose request
  /// is answered; nodes on another DDS do so in another way, and don't find it.
  /// Requests are answered one at a time on a thread of their own. One for which @p handler throws
  /// gets no answer and is counted as refused. @param service as a node names it: "~/get_state"
  /// @param type "lifecycle_msgs/srv/GetState" @throws std::runtime_error
  void serve(const std::string& service, std::string_view type, Handler handler);

  /// Number of messages that were not sent, since DDS refused them.
  std::uint64_t dropped() const;
  /// Number of messages for which a taker has thrown.
  std::uint64_t refused() const;

 private:
  struct Parts;
  class Service;
  std::unique_ptr<Parts> parts_;
};

/// "rt/scan" of "/scan", as topics of ROS are called in DDS. @param topic the whole name
std::string ddsTopic(const std::string& topic);
/// "sensor_msgs::msg::dds_::LaserScan_" of "sensor_msgs/msg/LaserScan".
std::string ddsType(std::string_view type);

}  // namespace ortung::ros2

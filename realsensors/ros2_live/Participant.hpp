#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

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

/// A node of ROS 2 on DDS alone: topics, types and quality of service as rmw_fastrtps has them,
/// over UDP only, since shared memory of different versions does not go together. Publishing never
/// blocks for a reader. Thread-safe.
class Participant {
 public:
  struct Options {
    std::string node = "ortung";  ///< name of the node
    std::string space = "/";      ///< its namespace, which begins with '/'
    std::uint32_t domain = 0;     ///< ROS_DOMAIN_ID
    bool isLocal = false;         ///< whether it talks on this machine only
    Distro distro = Distro::kHumble;
    /// Reads domain and range from the environment: ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY,
    /// ROS_AUTOMATIC_DISCOVERY_RANGE. @throws std::runtime_error naming a variable that is no such
    void readEnvironment();
  };
  /// Gets the bytes of a message (CDR with its head), which are valid during the call, on a thread
  /// of DDS. A message for which it throws is counted as refused.
  using Taker = std::function<void(std::string_view cdr)>;
  using Sender = std::function<void(std::string_view cdr)>;

  /// @throws std::runtime_error if DDS can't begin
  explicit Participant(const Options& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Reads a topic. @param topic as ROS names it, "/scan" @param type "sensor_msgs/msg/LaserScan"
  /// @throws std::runtime_error
  void subscribe(const std::string& topic, std::string_view type, Qos qos, Taker taker);
  /// Offers a topic. @return what sends a message; valid as long as this
  /// @throws std::runtime_error
  Sender publish(const std::string& topic, std::string_view type, Qos qos);

  /// Number of messages that were not sent, since DDS refused them.
  std::uint64_t dropped() const;
  /// Number of messages for which a taker has thrown.
  std::uint64_t refused() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// "rt/scan" of "/scan", as topics of ROS are called in DDS.
std::string ddsTopic(const std::string& topic);
/// "sensor_msgs::msg::dds_::LaserScan_" of "sensor_msgs/msg/LaserScan".
std::string ddsType(std::string_view type);

}  // namespace ortung::ros2

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "DescribedRobot.hpp"
#include "Participant.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {

/// What a message board says of a robot and its world.
struct BoardText {
  std::vector<std::string> robot;  ///< lines of `DESCRIBE robot`
  std::vector<std::string> world;  ///< of `DESCRIBE world`
  std::vector<std::string> field;  ///< of `DESCRIBE field`; none: there is no map
};

/// A robot of a message board as ROS 2 sees it: its readings, frames, map and clock as topics of a
/// node. Not thread-safe.
class RobotNode {
 public:
  struct Options {
    /// Before the names of frames; then frames and map, which robots share, are at /tf, /tf_static
    /// and /map, else in the node's namespace as all other topics but /clock.
    std::string framePrefix = {};
    std::string base = "base_link", odom = "odom";  ///< frames
    RobotTopics::MapFrame mapFrame = RobotTopics::MapFrame::kNone;
    /// Queries "MODEL/TYPE/FEATURE" of the features that are told.
    std::vector<std::string> features = {"*/*/*"};
    bool tellsTruth = false;  ///< whether the true pose is at ground_truth
    bool tellsClock = true, tellsMap = true;
    double mapHeight = 0.3;  ///< the map shows what is so high over the floor [m]
    Distro distro = Distro::kHumble;
  };

  /// Offers the topics. @param node borrowed
  /// @throws std::runtime_error of DDS; std::invalid_argument for what is no query
  RobotNode(const Options& options, const BoardText& board, Participant& node);

  /// Tells mounts and map. @param now by the robot's clock
  void start(Timestamp now);
  /// Tells what is new. @param readings in the order of their time
  void tell(Timestamp now, const std::vector<Message>& readings);

  /// What could not be told, in words and how often.
  const std::map<std::string, std::uint64_t>& leftOut() const { return leftOut_; }
  /// The features that it needs, for the board: queries, separated by blanks.
  std::string queries() const;
  /// Names of the topics that are offered, as a node names them: "scan", "/clock".
  std::vector<std::string> topics() const;

 private:
  struct Told {
    std::size_t topic;
    std::string cdr;
  };
  std::string nameOf(const Topic& topic) const;
  bool isWanted(const Topic& topic) const;
  void offer(std::size_t topic);
  RobotTopics::Sink collector();
  void send();
  void tellReadings(std::span<const Message> moment);

  const Options options_;
  Participant& node_;
  std::unique_ptr<foxglove::DescribedRobot> robot_;
  std::optional<OccupancyGrid> map_;
  std::map<std::size_t, Participant::Sender> senders_;  ///< by index of the topic
  std::map<std::size_t, std::string> names_;            ///< of those, as ROS has them
  Participant::Sender clock_;
  std::optional<Timestamp> toldClock_;
  std::vector<Told> told_;  ///< of one moment, before it goes out
  std::map<std::string, std::uint64_t> leftOut_;
};

}  // namespace ortung::ros2

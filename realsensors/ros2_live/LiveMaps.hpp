#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "LiveRequests.hpp"
#include "NodeMessages.hpp"
#include "OwnWorld.hpp"
#include "Participant.hpp"

namespace ortung::ros2 {

/// The maps of a node that has them itself: tells the one of the robot's floor, as Nav2's
/// map_server does, and takes its service load_map. Thread-safe.
class LiveMaps {
 public:
  struct Options {
    std::string topic = "map";     ///< topic of the maps
    std::string frame = "map";     ///< frame of the maps
    std::filesystem::path folder;  ///< folder for worlds that are made of maps
  };
  /// Another world than the present one, that somebody asks for.
  struct Wanted {
    OwnWorld world;
    std::string floor;  ///< the robot's floor there; "": it has none
  };

  /// @param requests what is asked of the localization, which outlives this
  LiveMaps(OwnWorld world, Options options, LiveRequests& requests);

  /// Offers the topic of the map and the service. @throws std::runtime_error of DDS
  void serve(Participant& node);
  /// Tells the map of a floor ("": of the first one), if it is another one than was told last.
  void tell(const std::string& floor);
  /// Takes a nav2_msgs/srv/LoadMap: the name of a floor, or a map file of one, says that the robot
  /// is on that floor. Another map's file is wanted as a world of its own, and a floor of the first
  /// world while that one is not in force as that world. @return the answer (CDR)
  /// @throws std::invalid_argument for bytes that are no request
  std::string load(std::string_view request);

  bool isAnotherWanted() const;
  /// Takes the world that is wanted. @pre isAnotherWanted()
  Wanted takeWanted();
  /// Goes on with a world.
  void use(const OwnWorld& world);
  /// The world in force.
  OwnWorld world() const;

 private:
  LoadedMap answer(const std::string& url);
  LoadedMap read(const std::filesystem::path& file) const;
  void want(const std::filesystem::path& map);

  const OwnWorld first_;
  const Options options_;
  LiveRequests& requests_;  ///< borrowed
  Participant::Sender send_;
  mutable std::mutex mutex_;
  OwnWorld world_;
  std::optional<Wanted> wanted_;
  std::optional<std::string> told_;  ///< floor whose map was told last
};

}  // namespace ortung::ros2

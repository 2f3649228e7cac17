#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// A request for a player: plugin, options and robot.
struct PlayerWish {
  std::string plugin;
  Parameters options;  ///< the plugin's options
  std::string team;    ///< name of its team; "": none
  /// Name of its robot; "": the name in the robot file, with a number if that is taken.
  std::string name;
  std::filesystem::path robot;  ///< the robot file; empty: the player's default
  /// The robot's table file; empty: it has none, or learns what it needs.
  std::filesystem::path tables;
  std::optional<Pose2> start;  ///< start pose in the field frame; nothing: a random one
  bool seesStage = true;       ///< whether it may read and change the world's true state
};

/// A request for a referee: plugin and options.
struct RefereeWish {
  std::string plugin;
  Parameters options;  ///< the plugin's options
};

/// Reads "PLUGIN[:key=value&key=value...]", e.g. "soccer:league=msl". @throws ConfigError
ORTUNG_API RefereeWish parseReferee(const std::string& text);

/// Reads "PLUGIN[:key=value&key=value...][@TEAM]", e.g. "goalkeeper:policy=blocking@blue". `robot`
/// and `tables` (files), `name`, `start` (x,y,theta in metres and degrees) and `stage` (yes, no)
/// are read here; all other keys are options of the plugin: numbers, yes and no, and texts.
/// @throws ConfigError that says what is wrong with the text
ORTUNG_API PlayerWish parsePlayer(const std::string& text);

/// Reads the same options from a table of a scene: `plugin`, `team`, `name`, `robot`, `tables`,
/// `start`, `stage` and the table `options`. @param folder of the scene's file @throws ConfigError
ORTUNG_API PlayerWish readPlayer(const Parameters& table, const std::filesystem::path& folder);

}  // namespace ortung

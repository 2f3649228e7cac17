#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// A player that is to be started.
struct PlayerWish {
  std::string plugin;
  Parameters options;            ///< of the plugin
  std::string team;              ///< "": none
  std::string name;              ///< of its robot; "": as its file says, or with a number behind it
  std::filesystem::path robot;   ///< its file; empty: the player's own
  std::filesystem::path tables;  ///< of its robot; empty: it has none, or learns what it needs
  std::optional<Pose2> start;    ///< in the field frame; nothing: anywhere
  bool seesStage = true;         ///< whether it may look at the world's state and change it
};

/// A referee that is to watch.
struct RefereeWish {
  std::string plugin;
  Parameters options;  ///< of the plugin
};

/// Reads "PLUGIN[:key=value&key=value...]", e.g. "soccer:league=msl". @throws ConfigError
ORTUNG_API RefereeWish parseReferee(const std::string& text);

/// Reads "PLUGIN[:key=value&key=value...][@TEAM]", e.g. "goalkeeper:policy=blocking@blue". `robot`
/// and `tables` (files), `name`, `start` (x,y,theta in metres and degrees) and `stage` (yes, no)
/// are for whoever starts it, all others for the plugin: numbers, yes and no, and texts.
/// @throws ConfigError saying what is wrong with the text
ORTUNG_API PlayerWish parsePlayer(const std::string& text);

/// The same options from a table of a scene: `plugin`, `team`, `name`, `robot`, `tables`, `start`,
/// `stage` and the table `options`. @param folder of the scene's file @throws ConfigError
ORTUNG_API PlayerWish readPlayer(const Parameters& table, const std::filesystem::path& folder);

}  // namespace ortung

#pragma once

#include <array>
#include <memory>
#include <string>

#include "SensorRig.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung {

/// The simulation half of a motion plugin, of a [drive] table.
inline std::unique_ptr<Drive> makeDrive(const std::string& plugin, const std::string& toml) {
  PluginFactory factory(PluginFactory::standardFolders());
  return factory.make<Drive>(plugin, parseToml(toml, "robot.toml"));
}

/// The half that MCL uses, of a [motion] table.
inline std::unique_ptr<MotionModel> makeMotion(const std::string& plugin, const std::string& toml) {
  PluginFactory factory(PluginFactory::standardFolders());
  return factory.make<MotionModel>(plugin, parseToml(toml, "robot.toml"));
}

}  // namespace ortung

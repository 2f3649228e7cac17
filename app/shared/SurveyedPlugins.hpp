#pragma once

#include <map>
#include <string>

#include "KeySurvey.hpp"
#include "ortung/core/PluginFactory.hpp"

namespace ortung::app {

/// Plugins whose settings are tables of files, by the table.
enum class PluginKind { kSensor, kMotion, kDrive };

/// Returns the keys of a plugin's table, `plugin` among them. All parts that a sensor plugin has
/// are asked: what is stored, what simulates it, and what extracts it from other readings.
/// @throws PluginError if there is no such plugin
KeySurvey surveyPlugin(PluginFactory& factory, PluginKind kind, const std::string& name);

/// The same of all plugins of a kind that are found, by their names.
std::map<std::string, KeySurvey> surveyPlugins(PluginKind kind);

}  // namespace ortung::app

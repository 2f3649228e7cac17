#include "SurveyedPlugins.hpp"

#include <exception>
#include <set>
#include <string_view>

#include "ortung/core/Extractor.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/sim_api/Drive.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung::app {
namespace {

/// Returns the interface that each plugin of a kind has.
std::string_view interfaceOf(PluginKind kind) {
  switch (kind) {
    case PluginKind::kSensor:
      return SensorData::kInterface;
    case PluginKind::kMotion:
      return MotionModel::kInterface;
    case PluginKind::kDrive:
      return Drive::kInterface;
  }
  return "";
}

/// Finds the keys of a part that a plugin may have besides the first one.
template <class Part>
void addPart(KeySurvey& survey, PluginFactory& factory, const std::string& name) {
  bool isThere = false;
  const KeySurvey part = surveyKeys([&](const Parameters& table) {
    table.text("plugin");
    isThere = factory.makeIfThere<Part>(name, table) != nullptr || isThere;
  });
  if (isThere) survey.addReader(part);
}

}  // namespace

KeySurvey surveyPlugin(PluginFactory& factory, PluginKind kind, const std::string& name) {
  std::exception_ptr missing;
  const auto read = [&](const Parameters& table) {
    table.text("plugin");
    try {
      if (kind == PluginKind::kSensor) factory.makeData(name, table);
      if (kind == PluginKind::kMotion) factory.make<MotionModel>(name, table);
      if (kind == PluginKind::kDrive) factory.make<Drive>(name, table);
    } catch (const PluginError&) {
      missing = std::current_exception();
      throw;
    }
  };
  KeySurvey survey = surveyKeys(read);
  // A plugin that is there has asked something, even if it could not be made.
  if (missing && survey.keys.size() <= 1) std::rethrow_exception(missing);
  if (kind != PluginKind::kSensor) return survey;
  addPart<Sensor>(survey, factory, name);
  addPart<Extractor>(survey, factory, name);
  return survey;
}

std::map<std::string, KeySurvey> surveyPlugins(PluginKind kind) {
  PluginFactory factory(PluginFactory::standardFolders());
  std::set<std::string> names;
  for (const PluginFactory::Found& found : factory.list())
    for (const auto& entry : found.entries)
      if (entry.interface == interfaceOf(kind)) names.insert(entry.name);
  std::map<std::string, KeySurvey> surveys;
  for (const std::string& name : names) surveys[name] = surveyPlugin(factory, kind, name);
  return surveys;
}

}  // namespace ortung::app

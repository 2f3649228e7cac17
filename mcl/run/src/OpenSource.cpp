#include "ortung/run/OpenSource.hpp"

#include <set>

#include "ortung/core/SourceOptions.hpp"
#include "ortung/records/RecordSource.hpp"

namespace ortung {
namespace {

SourceText parse(const std::string& text) {
  try {
    return parseSourceText(text);
  } catch (const std::invalid_argument& error) {
    throw SourceTextError(error.what());
  }
}

std::unique_ptr<Source> openRecord(const SourceText& text) {
  constexpr double kLongest = 1e9;  // [s]
  Parameters options("record:" + text.path);
  for (const auto& [key, value] : text.options) {
    if (key != "from_s" && key != "to_s")
      throw SourceTextError(options.where() + ": a record knows no option '" + key +
                            "', but from_s and to_s");
    options.set(key, value);
  }
  RecordPart part;
  try {
    part.from = optionNumber(options, "from_s", part.from, {0.0, kLongest});
    part.to = optionNumber(options, "to_s", {part.from, kLongest}).value_or(part.to);
  } catch (const ConfigError& error) {
    throw SourceTextError(error.what());
  }
  return std::make_unique<RecordSource>(text.path, part);
}

/// The known sources, and why some libraries, which may have more, could not be loaded.
struct Kinds {
  std::set<std::string> names = {"record"};
  std::string complaints;
};

Kinds kindsOf(PluginFactory& factory) {
  Kinds kinds;
  for (const PluginFactory::Found& library : factory.list()) {
    if (!library.error.empty()) kinds.complaints += "; not loaded: " + library.error;
    for (const auto& entry : library.entries)
      if (entry.interface == Source::kInterface) kinds.names.insert(entry.name);
  }
  return kinds;
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

SourceTextError::~SourceTextError() = default;

std::unique_ptr<Source> openSource(const std::string& text, const std::filesystem::path& robotFile,
                                   PluginFactory& factory) {
  return openSource(parse(text), robotFile, factory);
}

std::unique_ptr<Source> openSource(const SourceText& text, const std::filesystem::path& robotFile,
                                   PluginFactory& factory) {
  if (text.kind == "record") return openRecord(text);
  Parameters parameters(text.kind + ":" + text.path);
  for (const auto& [key, value] : text.options) {
    if (key == "path" || key == "robot_file") {
      throw SourceTextError(parameters.where() + ": '" + key + "' is no option of a source");
    }
    parameters.set(key, value);
  }
  parameters.set("path", text.path);
  parameters.set("robot_file", robotFile.string());
  try {
    return factory.make<Source>(text.kind, parameters);
  } catch (const PluginError&) {
    const Kinds kinds = kindsOf(factory);
    if (kinds.names.contains(text.kind)) throw;
    throw PluginError(parameters.where() + ": there is no kind of source '" + text.kind +
                      "', expected one of " + joined(kinds.names) + kinds.complaints);
  }
}

}  // namespace ortung

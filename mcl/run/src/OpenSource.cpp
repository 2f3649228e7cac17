#include "ortung/run/OpenSource.hpp"

#include "ortung/core/Record.hpp"

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
  if (!text.options.empty()) {
    throw SourceTextError("record:" + text.path + ": a record knows no option '" +
                          text.options.begin()->first + "'");
  }
  return std::make_unique<RecordSource>(text.path);
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
  return factory.make<Source>(text.kind, parameters);
}

}  // namespace ortung

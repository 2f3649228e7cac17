#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"

namespace ortung {

/// Thrown if the text that names a source is wrong by itself, whatever the files that it names.
class ORTUNG_API SourceTextError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
  ~SourceTextError() override;
};

/// Opens "KIND:PATH?key=value&key=value". "record" is built in, every other kind is a plugin.
/// @param robotFile the source's "robot_file"; may be empty
/// @throws SourceTextError, PluginError, ConfigError, std::runtime_error
ORTUNG_API std::unique_ptr<Source> openSource(const std::string& text,
                                              const std::filesystem::path& robotFile,
                                              PluginFactory& factory);
ORTUNG_API std::unique_ptr<Source> openSource(const SourceText& text,
                                              const std::filesystem::path& robotFile,
                                              PluginFactory& factory);

}  // namespace ortung

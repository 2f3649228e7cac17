#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/run/Feeder.hpp"

namespace ortung::app {

/// Opens the source that the command line names.
/// @throws UsageError for the text itself; else as ortung::openSource()
std::unique_ptr<Source> openSourceArgument(const std::string& text,
                                           const std::filesystem::path& robotFile,
                                           PluginFactory& factory);
std::unique_ptr<Source> openSourceArgument(const SourceText& text,
                                           const std::filesystem::path& robotFile,
                                           PluginFactory& factory);

/// Says once, on stderr, which features of the source @p name the robot file lacks.
void warnOfUnknown(const std::string& name, const Feeder& feeder);

}  // namespace ortung::app

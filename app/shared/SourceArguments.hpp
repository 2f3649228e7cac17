#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/records/RecordWriter.hpp"
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

/// What @p next says, which reads from @p source; false if a signal came and the source is live:
/// then the signal is its end. @throws Interrupted for any other source; else what @p next throws
bool unlessInterrupted(const Source& source, const std::function<bool()>& next);

/// What can't be had again is recorded as it comes.
inline RecordWriter::Pace paceOf(const Source& source) {
  return source.isLive() ? RecordWriter::Pace::kLive : RecordWriter::Pace::kWhole;
}

/// Says on stderr what there is to say of a source after its end.
void warnOf(const Source& source);
/// The same, and which features of the source @p name the robot file lacks.
void warnOf(const std::string& name, const Source& source, const Feeder& feeder);

}  // namespace ortung::app

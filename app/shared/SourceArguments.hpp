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

/// Opens a source of the command line.
/// @throws UsageError for invalid text; else as ortung::openSource()
std::unique_ptr<Source> openSourceArgument(const std::string& text,
                                           const std::filesystem::path& robotFile,
                                           PluginFactory& factory);
std::unique_ptr<Source> openSourceArgument(const SourceText& text,
                                           const std::filesystem::path& robotFile,
                                           PluginFactory& factory);

/// Returns the result of @p next, which reads from @p source. A signal ends a live source: then
/// false. @throws Interrupted at a signal, for any other source; else what @p next throws
bool unlessInterrupted(const Source& source, const std::function<bool()>& next);

/// Returns how to record a source: live ones as they come, since they can't be read again.
inline RecordWriter::Pace paceOf(const Source& source) {
  return source.isLive() ? RecordWriter::Pace::kLive : RecordWriter::Pace::kWhole;
}

/// Returns the notes of a record of a source: the formats that it knows and, of other features,
/// those of the robot whose container is given.
RecordNotes notesOf(const Source& source, const SensorContainer& robot = {});

/// Prints the remark of a source after its end on stderr.
void warnOf(const Source& source);
/// Prints that, and the features of the source @p name that are not in the robot file.
void warnOf(const std::string& name, const Source& source, const Feeder& feeder);

}  // namespace ortung::app

#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// What a file is, as far as its first bytes tell.
enum class FileKind {
  kUnknown,
  kTables,     ///< tables of `ortung learn`, or a part of a job
  kRecord,     ///< a record, compressed or lines of text
  kRobot,      ///< a robot file
  kWorld,      ///< a world file
  kScene,      ///< a scene file
  kSweep,      ///< the file of a sweep
  kMotion,     ///< motion noise of `ortung learn-motion`
  kMapServer,  ///< a map of ROS's map_server (Nav2)
  kCarmenLog,
  kPicture,       ///< PNG, JPEG, GIF, PGM or PPM
  kMcap,          ///< MCAP, e.g. a bag of ROS 2
  kSqlite,        ///< a database of SQLite, e.g. a bag of ROS 2
  kRosBag,        ///< a bag of ROS 1
  kRosBagFolder,  ///< a folder with a bag of ROS 2
  kFolder,        ///< another folder
  kZip,           ///< another ZIP archive
  kGzip,          ///< compressed by gzip, e.g. a rawlog
  kHtml,
  kJson,
};

/// Returns the kind of a file or folder; kUnknown also if it can't be read.
ORTUNG_API FileKind kindOfFile(const std::filesystem::path& file);
/// Returns the kind of a file with these first bytes, at most 64 kB.
ORTUNG_API FileKind kindOfBytes(std::string_view begin);

/// Returns the name of a kind with its article and what it is for: "a robot file (for --robot)"; ""
/// for one that is not known.
ORTUNG_API std::string nameOf(FileKind kind);

/// Returns what a file is, for the end of an error about a file of which another kind was expected:
/// "; it is a robot file (for --robot)"; "" if its kind is not known or one of @p expected.
ORTUNG_API std::string whatItIs(const std::filesystem::path& file,
                                std::initializer_list<FileKind> expected = {});

}  // namespace ortung

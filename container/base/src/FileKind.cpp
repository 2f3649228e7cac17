#include "ortung/base/FileKind.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>
#include <utility>

namespace ortung {
namespace {

constexpr std::size_t kMostBytes = 64 << 10;  ///< bytes at the beginning that are looked at

struct Magic {
  std::string_view bytes;
  FileKind kind;
};
constexpr std::array kMagics = {
    Magic{"# ortung record ", FileKind::kRecord},
    Magic{"\x89MCAP0\r\n", FileKind::kMcap},
    Magic{"SQLite format 3", FileKind::kSqlite},
    Magic{"#ROSBAG V", FileKind::kRosBag},
    Magic{"\x1f\x8b", FileKind::kGzip},
    Magic{"\x89PNG", FileKind::kPicture},
    Magic{"\xff\xd8\xff", FileKind::kPicture},
    Magic{"GIF8", FileKind::kPicture},
    Magic{"P5", FileKind::kPicture},
    Magic{"P6", FileKind::kPicture},
    Magic{"P2", FileKind::kPicture},
};

/// How a line of a text begins that files of one kind have.
constexpr std::array kLines = {
    Magic{"[scene]", FileKind::kScene},
    Magic{"[vary]", FileKind::kSweep},
    Magic{"[[sensor]]", FileKind::kRobot},
    Magic{"[robot]", FileKind::kRobot},
    Magic{"[world]", FileKind::kWorld},
    Magic{"[[rectangle]]", FileKind::kWorld},
    Magic{"[[ellipse]]", FileKind::kWorld},
    Magic{"[[triangle]]", FileKind::kWorld},
    Magic{"[[grid]]", FileKind::kWorld},
    Magic{"[[landmark]]", FileKind::kWorld},
    Magic{"[[floor]]", FileKind::kWorld},
    Magic{"[motion]", FileKind::kMotion},
    Magic{"occupied_thresh:", FileKind::kMapServer},
    Magic{"FLASER ", FileKind::kCarmenLog},
    Magic{"ODOM ", FileKind::kCarmenLog},
    Magic{"PARAM ", FileKind::kCarmenLog},
    Magic{"ROBOTLASER1 ", FileKind::kCarmenLog},
};

std::string_view withoutBlanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin == text.npos ? "" : text.substr(begin);
}

FileKind kindOfText(std::string_view text) {
  const std::string_view first = withoutBlanks(text);
  if (first.starts_with("<!DOCTYPE html") || first.starts_with("<!doctype html") ||
      first.starts_with("<html"))
    return FileKind::kHtml;
  if (first.starts_with("{")) return FileKind::kJson;
  // A robot file may have [motion], too, so that tells only where nothing else does.
  FileKind kind = FileKind::kUnknown;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = withoutBlanks(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    for (const Magic& sign : kLines) {
      if (!line.starts_with(sign.bytes)) continue;
      if (sign.kind != FileKind::kMotion) return sign.kind;
      kind = sign.kind;
    }
  }
  return kind;
}

}  // namespace

FileKind kindOfBytes(std::string_view begin) {
  begin = begin.substr(0, kMostBytes);
  for (const Magic& magic : kMagics)
    if (begin.starts_with(magic.bytes)) return magic.kind;
  // A skippable frame of zstd holds the name of compressed records.
  if (begin.substr(0, 64).find("ortung record ") != begin.npos) return FileKind::kRecord;
  // All members of our archives are arrays of NumPy.
  if (begin.starts_with("PK\x03\x04"))
    return begin.find(".npy") != begin.npos ? FileKind::kTables : FileKind::kZip;
  return kindOfText(begin);
}

FileKind kindOfFile(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    return std::filesystem::exists(file / "metadata.yaml", error) ? FileKind::kRosBagFolder
                                                                  : FileKind::kFolder;
  // What a pipe or a device has given once is gone.
  if (!std::filesystem::is_regular_file(file, error)) return FileKind::kUnknown;
  std::ifstream in(file, std::ios::binary);
  std::string begin(kMostBytes, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return kindOfBytes(begin);
}

std::string nameOf(FileKind kind) {
  switch (kind) {
    case FileKind::kUnknown:
      return "";
    case FileKind::kTables:
      return "a file of tables of `ortung learn` (for --tables) or of a part of a job (for `ortung "
             "merge`)";
    case FileKind::kRecord:
      return "a record (as a source: record:FILE)";
    case FileKind::kRobot:
      return "a robot file (for --robot)";
    case FileKind::kWorld:
      return "a world file (for --world)";
    case FileKind::kScene:
      return "a scene file (for `ortung sim`)";
    case FileKind::kSweep:
      return "a file of a sweep (for `ortung sweep`)";
    case FileKind::kMotion:
      return "a motion file (for --motion)";
    case FileKind::kMapServer:
      return "a map of map_server (for --world)";
    case FileKind::kCarmenLog:
      return "a log of CARMEN (as a source: carmen:FILE)";
    case FileKind::kPicture:
      return "a picture";
    case FileKind::kMcap:
      return "an MCAP file (as a source: mcap:FILE)";
    case FileKind::kSqlite:
      return "a database of SQLite, such as a bag of ROS 2 (as a source: bag:FILE)";
    case FileKind::kRosBag:
      return "a bag of ROS 1 (as a source: bag:FILE)";
    case FileKind::kRosBagFolder:
      return "a folder with a bag of ROS 2 (as a source: bag:FOLDER)";
    case FileKind::kFolder:
      return "a folder";
    case FileKind::kZip:
      return "a ZIP archive";
    case FileKind::kGzip:
      return "a file of gzip, such as a rawlog of MRPT (as a source: rawlog:FILE)";
    case FileKind::kHtml:
      return "a page of HTML";
    case FileKind::kJson:
      return "a file of JSON";
  }
  return "";
}

std::string whatItIs(const std::filesystem::path& file, std::initializer_list<FileKind> expected) {
  const FileKind kind = kindOfFile(file);
  if (kind == FileKind::kUnknown) return "";
  if (std::find(expected.begin(), expected.end(), kind) != expected.end()) return "";
  return "; it is " + nameOf(kind);
}

}  // namespace ortung

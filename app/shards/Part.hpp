#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "Shard.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung::app {

/// What a part is a part of. `ortung merge` joins parts of one job.
struct PartHead {
  std::string kind;  ///< what made it: "learn", "eval", "goalkeeper", ...
  /// All that determines the result, as a JSON object: options by name, files by their contents'
  /// digests. It does not depend on the shard, nor on where files lie.
  std::string job;
  Shard shard;
  /// What merging needs beside the parts, as a JSON object, e.g. names of files. It is taken from
  /// the first part.
  std::string needs = "{}";
  std::string version = versionHere();  ///< the program's; other versions may compute otherwise
  std::map<std::string, std::string> inputs = {};  ///< digests of the files that were read, by name
  /// Digests of the program's own files, by name: two builds of one version may compute otherwise.
  std::map<std::string, std::string> programs = {};

  /// Returns the version of this program, as parts name it.
  static std::string versionHere();
};

/// Writes the part of a shard: a file of tables that numpy reads, too, with part.json as its head.
/// It appears whole or not at all, so it does no harm if two machines write it at the same time.
class PartWriter {
 public:
  PartWriter(const std::filesystem::path& file, PartHead head);
  TableWriter& content() { return content_; }
  /// Adds the digests of the program and of all files that this process has read to the head, and
  /// puts the file in its place. @throws TableError
  void commit();

 private:
  PartHead head_;
  TableWriter content_;
};

/// Reads and checks a part's head. @throws TableError if it is no part
PartHead headOf(const TableFile& part);

/// Returns a digest of what a part contains, its head excepted.
std::string contentOf(const TableFile& part);

}  // namespace ortung::app

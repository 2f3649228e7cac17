#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "Part.hpp"

namespace ortung::app {

/// Thrown for parts that can't be joined; has a line for each reason.
class PartError : public std::runtime_error {
 public:
  explicit PartError(std::vector<std::string> reasons);
  const std::vector<std::string>& reasons() const { return reasons_; }

 private:
  std::vector<std::string> reasons_;
};

/// Exit code of commands whose parts can't be joined.
inline constexpr int kBadParts = 3;

/// All parts of one job. It keeps their heads only; each is opened when it is needed.
class PartSet {
 public:
  /// Checks that the files are the parts of one job, made by this version, all of them; in any
  /// order, and also more than once if they are equal.
  /// @throws PartError naming every file that is torn or foreign and every shard that is missing
  explicit PartSet(const std::vector<std::filesystem::path>& files);

  /// Checks that the files from which the parts were made are here, and the same.
  /// @throws PartError naming each that is not
  void requireInputs() const;

  /// Returns the head of shard 1, with the inputs of all.
  const PartHead& head() const { return head_; }
  std::size_t size() const { return files_.size(); }  ///< number of shards
  /// Opens a shard. @param index its number less 1
  TableFile open(std::size_t index) const { return TableFile(files_.at(index)); }
  /// Returns the JSON that a shard has in an array of bytes. @throws TableError
  std::string textOf(std::size_t index, const std::string& name) const;

 private:
  PartHead head_;
  std::vector<std::filesystem::path> files_;  ///< by number of shard
};

/// Adds a text as an array of bytes, which may be as long as a table.
void addLongText(TableWriter& file, const std::string& name, const std::string& text);

}  // namespace ortung::app

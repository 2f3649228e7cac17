#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <list>
#include <optional>
#include <span>
#include <utility>

namespace ortung::ros2 {

/// Tables that this program has learned, by the files that they were made of, so that maps that
/// replace each other in turn, as those of floors do, are learned once each. Not thread-safe.
class LearnedMaps {
 public:
  static constexpr std::size_t kMost = 8;  ///< tables that are kept

  explicit LearnedMaps(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// What tables of these files are known by. @throws std::runtime_error if one can't be read
  static std::uint64_t keyOf(std::span<const std::filesystem::path> files);

  /// The tables of a key; nothing if they have yet to be learned.
  std::optional<std::filesystem::path> find(std::uint64_t key);
  /// The file for tables that will be learned, in place of those that were asked for longest ago,
  /// which are forgotten.
  std::filesystem::path fileForNext();
  /// Keeps tables that were learned.
  void keep(std::uint64_t key, const std::filesystem::path& tables);

 private:
  const std::filesystem::path folder_;
  std::list<std::pair<std::uint64_t, std::filesystem::path>> known_;  ///< newest first
};

}  // namespace ortung::ros2

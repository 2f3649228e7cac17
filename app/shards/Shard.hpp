#pragma once

#include <cstdint>
#include <string>

namespace ortung::app {

/// One of the equal parts into which a job is cut. Its result depends on job, number and count
/// alone.
struct Shard {
  std::uint64_t number = 1;  ///< its number, from 1
  std::uint64_t count = 1;   ///< number of all shards

  /// Returns whether it has a unit of work, if units are dealt out like cards.
  bool has(std::uint64_t unit) const { return unit % count == number - 1; }
  bool operator==(const Shard&) const = default;
};

/// The greatest number of shards of a job.
inline constexpr std::uint64_t kMostShards = 1'000'000;

/// Parses "2/7". @throws UsageError
Shard readShard(const std::string& text);

/// Returns "2/7".
std::string toText(const Shard& shard);

}  // namespace ortung::app

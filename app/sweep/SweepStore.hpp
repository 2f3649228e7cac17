#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "PartSet.hpp"
#include "SweepCosts.hpp"
#include "SweepFile.hpp"

namespace ortung::app {

/// The folder of a sweep: what was done, told by its files alone.
///
///   sweep.toml, folder.txt       the sweep, and the folder of its relative paths
///   tasks/ID.part                results of tasks whose shard is not done
///   shards/I-of-N.pack           results of a shard's tasks
///   costs/ID.tsv, I-of-N.tsv     seconds and memory of these tasks
///   failed/ID.txt                what a task said that failed
///
/// Each file is written atomically, and its content depends on the sweep alone, so several machines
/// may work in one folder, even on the same tasks. Not thread-safe.
class SweepStore {
 public:
  enum class State : std::uint8_t { kMissing, kDone, kStale, kTorn, kFailed };
  /// What is known of a task.
  struct Result {
    State state = State::kMissing;
    std::string why;  ///< why it is stale or torn
  };

  /// Makes the folder if it is not there. @throws std::runtime_error
  SweepStore(const std::filesystem::path& folder, const SweepFile& sweep);
  /// Opens the folder of a sweep that was begun. @throws std::runtime_error if there is none
  static SweepFile sweepOf(const std::filesystem::path& folder);

  /// Looks at all files anew.
  void look();
  Result resultOf(const SweepTask& task);
  /// Returns the JSON that the task's command would have written. @pre it is done or stale
  std::string figuresOf(const SweepTask& task) const;
  /// Returns what a task said that failed.
  std::string saidBy(const SweepTask& task) const;
  std::optional<SweepCost> costOf(const std::string& id) const;

  std::filesystem::path partOf(const std::string& id) const;
  std::filesystem::path failureOf(const std::string& id) const;
  /// Keeps what tasks have cost whose shard is not done.
  void keep(const std::map<std::string, SweepCost>& costs) const;
  /// Writes the results of a shard into one file, and removes the files of its tasks.
  /// @pre all of them are done
  void pack(const Shard& shard, const std::vector<SweepTask>& tasks,
            const std::map<std::string, SweepCost>& costs);

 private:
  /// From what a result was made.
  struct Origin {
    std::string version;
    std::map<std::string, std::string> inputs;
    std::map<std::string, std::string> programs;
    bool operator==(const Origin&) const = default;
  };
  struct Place {
    std::filesystem::path file;
    std::size_t origin = 0;  ///< index in origins_
    std::size_t index = 0;   ///< in a pack
    bool isPacked = false;
  };
  std::filesystem::path costsOf(const std::string& name) const;
  std::size_t originNumber(Origin origin);
  void lookAtPack(const std::filesystem::path& file);
  void lookAtTask(const std::filesystem::path& file);
  const std::string& stalenessOf(std::size_t origin);
  const std::string& digestNow(const std::string& name);
  const std::string& digestOfProgram(const std::string& name);

  std::filesystem::path folder_;
  const SweepFile& sweep_;
  std::vector<Origin> origins_;
  std::map<std::size_t, std::string> staleness_;              ///< by origin, once it was asked for
  std::map<std::string, std::string> digests_;                ///< of files as they are now
  std::map<std::string, std::string> programs_;               ///< of this program's own
  std::unordered_map<std::string, Place> places_;             ///< by id
  mutable std::map<std::filesystem::path, TableFile> packs_;  ///< those that were asked for figures
  std::map<std::string, std::string> torn_;                   ///< files that can't be read, and why
  std::unordered_map<std::string, SweepCost> costs_;
};

}  // namespace ortung::app

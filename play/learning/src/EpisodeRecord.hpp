#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "ortung/core/Message.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung::learning {

/// The record of what an agent's robot read in one episode, which is there from its first moment on
/// and whole at its end. A forked process leaves it to the process that began it.
class EpisodeRecord {
 public:
  /// Returns a name in which "{seed}" and "{number}" are replaced by those of an episode.
  static std::filesystem::path fileOf(const std::filesystem::path& pattern, std::uint64_t seed,
                                      std::uint64_t number);

  /// @param world its fingerprint
  /// @throws std::runtime_error if the file can't be written, or holds something else than a record
  EpisodeRecord(const std::filesystem::path& file, const std::string& world,
                const SensorContainer& container);
  ~EpisodeRecord();
  EpisodeRecord(const EpisodeRecord&) = delete;
  EpisodeRecord& operator=(const EpisodeRecord&) = delete;

  /// Write the readings of a cycle, and the end. @throws std::runtime_error
  void write(std::span<const Message> readings);
  void end();

 private:
  bool isHere() const;

  std::unique_ptr<RecordWriter> writer_;
  pid_t process_;
};

}  // namespace ortung::learning

#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "ortung/records/RecordWriter.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::app {

/// A record of the readings of a localization's source and of what MCL says of them: estimates,
/// status, samples, ..., each at the time at which it is published. Not thread-safe.
class PublishedRecord {
 public:
  /// @param localization publishes (LocalizationConfig::publish), and has not begun; borrowed, must
  ///   outlive this
  /// @throws std::runtime_error if the file can't be written
  PublishedRecord(const std::filesystem::path& file, Localization& localization);
  ~PublishedRecord();

  /// Writes what is new since the last call. @throws std::runtime_error
  void writePublished();
  /// Makes the file appear. @throws std::runtime_error
  void commit() { record_.commit(); }

 private:
  Localization& localization_;
  RecordWriter record_;
  std::vector<std::uint64_t> seen_;  ///< sequence number last written of each feature
};

}  // namespace ortung::app

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "ortung/ros2/McapReader.hpp"

namespace ortung::ros2 {

/// A file of recorded messages of any of the formats that bags have, read front to back. The file
/// is not trusted: an item takes as much memory as there are bytes of it, and at most kMostBytes.
/// Not thread-safe.
class BagFile {
 public:
  static constexpr std::uint64_t kMostBytes = McapReader::kMostBytes;  ///< limit of an item [bytes]

  BagFile() = default;
  virtual ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// Reads the next message in the file's order, which is not always that of time; false at the
  /// end, also of an unfinished file.
  /// @param message out: its channel's encoding is "cdr" for ROS 2 and "ros1" for ROS 1, whose
  ///   types are called as there, e.g. "sensor_msgs/LaserScan"
  /// @throws std::runtime_error naming file, place, what was found and expected
  virtual bool next(McapMessage& message) = 0;
  /// Whether the file, as far as it was read, misses its end.
  virtual bool isUnfinished() const = 0;
  /// The robot file in a file that Ortung wrote, as far as it was read; or "".
  virtual std::string robotToml() const { return ""; }
};

/// Limits what the packed pieces of a file unpack to: small files could say much. Not thread-safe.
class UnpackedSize {
 public:
  static constexpr std::uint64_t kMostAtFirst = std::uint64_t{1} << 30;  ///< [bytes]
  static constexpr std::uint64_t kMostGain =
      256;  ///< bytes that a packed byte may make beyond that

  /// Adds a piece by its sizes [bytes]; false if all of them are more than a sound file has.
  bool add(std::uint64_t packed, std::uint64_t unpacked);

 private:
  std::uint64_t packed_ = 0;
  std::uint64_t unpacked_ = 0;
};

/// Whether bytes begin as those do that zstd compressed.
bool isZstd(std::string_view bytes);

/// Opens a file by its first bytes: MCAP, SQLite 3 (.db3 of rosbag2), a bag of ROS 1 (.bag), or one
/// of these compressed as a whole by zstd, which may have 1 GiB.
/// @throws std::runtime_error if it can't be read or begins otherwise
std::unique_ptr<BagFile> openBagFile(const std::filesystem::path& file);

}  // namespace ortung::ros2

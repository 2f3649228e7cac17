#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung::ros2 {

/// The definition of a message's type.
struct McapSchema {
  std::string name;      ///< name of the type, e.g. "nav_msgs/msg/Odometry"
  std::string encoding;  ///< form of the text, e.g. "ros2msg"
  std::string text;      ///< the definition
};
/// A stream of messages of one type.
struct McapChannel {
  std::uint16_t id = 0;                         ///< number of the channel
  std::string topic;                            ///< name of the topic, e.g. "/scan"
  std::string encoding;                         ///< encoding of the messages, e.g. "cdr"
  std::map<std::string, std::string> metadata;  ///< further properties
  McapSchema schema;                            ///< type of the messages; empty if it has none
};
/// A message of a channel.
struct McapMessage {
  const McapChannel* channel = nullptr;  ///< the channel; valid as long as the reader
  std::uint64_t logTime = 0;             ///< time of recording [ns since 1970]
  std::string_view data;                 ///< the message, valid until the next call of next()
};

/// Reads an MCAP file (mcap.dev/spec, version 0) front to back, chunked or not; a summary is
/// ignored. The file is not trusted: an item takes as much memory as there are bytes of it, and at
/// most kMostBytes. Not thread-safe.
class ORTUNG_API McapReader {
 public:
  static constexpr std::uint64_t kMostBytes = 1U << 27;  ///< limit of a record or chunk [bytes]

  /// Reads the beginning of a file.
  /// @param file the file, borrowed for as long as this lives
  /// @param name name of the file for errors
  /// @throws std::runtime_error if it does not begin like an MCAP file
  McapReader(std::istream& file, std::string name);
  ~McapReader();
  McapReader(const McapReader&) = delete;
  McapReader& operator=(const McapReader&) = delete;

  /// Reads the next message in the file's order, which is not always that of time; false at the
  /// end, also of an unfinished file.
  /// @throws std::runtime_error naming file, place, what was found and expected
  bool next(McapMessage& message);
  /// The file's profile: "ros2", "ros1", "" or another; known after the first call of next().
  const std::string& profile() const;
  /// Attachments that were read so far, by name; those of more than 1 MiB are left out.
  const std::map<std::string, std::string>& attachments() const;
  /// Whether the file ended within a record, or without its last records.
  bool isUnfinished() const;
  std::uint64_t position() const;  ///< number of bytes read

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::ros2

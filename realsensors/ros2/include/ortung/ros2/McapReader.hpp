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

struct McapSchema {
  std::string name;
  std::string encoding;
  std::string text;
};
struct McapChannel {
  std::uint16_t id = 0;
  std::string topic;
  std::string encoding;  ///< of messages, e.g. "cdr"
  std::map<std::string, std::string> metadata;
  McapSchema schema;  ///< empty if it has none
};
struct McapMessage {
  const McapChannel* channel = nullptr;
  std::uint64_t logTime = 0;  ///< [ns]
  std::string_view data;      ///< until the next call
};

/// Reads an MCAP file (mcap.dev/spec, version 0) front to back, chunked or not, with a summary or
/// without: that is not looked at. Nothing that the file says is believed: an item takes as much
/// memory as there are bytes of it, and no more than kMostBytes. Not thread-safe.
class ORTUNG_API McapReader {
 public:
  static constexpr std::uint64_t kMostBytes = 1U << 27;  ///< of a record, and of a chunk unpacked

  /// @param name what errors call the file
  /// @throws std::runtime_error if it does not begin like one
  McapReader(std::istream& file, std::string name);
  ~McapReader();
  McapReader(const McapReader&) = delete;
  McapReader& operator=(const McapReader&) = delete;

  /// The next message in the file's order, which is not always that of time; false at the end, also
  /// of a file that was never finished.
  /// @throws std::runtime_error naming file, place, what was found and expected
  bool next(McapMessage& message);
  /// "ros2", "ros1", "" or another; known once next() was called.
  const std::string& profile() const;
  /// Files within the file that came by so far, by name; those beyond 1 MiB are passed over.
  const std::map<std::string, std::string>& attachments() const;
  /// Whether the file ended where a record was not whole, or without its last ones.
  bool isUnfinished() const;
  std::uint64_t position() const;  ///< bytes read

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::ros2

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung::ros2 {

/// How a chunk of an MCAP file is packed.
enum class McapCompression : std::uint8_t { kNone, kLz4, kZstd };

/// Writes an MCAP file (mcap.dev/spec, version 0) front to back: messages in chunks with an index
/// each, and a summary at the end by which a reader finds any time of any channel. Everything has a
/// checksum. A file that was not finished is still readable up to its last whole chunk.
/// Not thread-safe.
class ORTUNG_API McapWriter {
 public:
  struct Options {
    std::string profile = "ros2";  ///< what kind of messages to expect
    McapCompression compression = McapCompression::kZstd;
    std::size_t chunkBytes = 1U << 20;  ///< a chunk ends when it has as many, unpacked
    bool isChunked = true;              ///< false: messages lie in the file one by one
  };
  /// Gets the file's bytes in their order; what it throws goes through.
  using Sink = std::function<void(std::string_view)>;

  McapWriter(Sink sink, Options options);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// @param encoding of the text, e.g. "ros2msg" @returns its number
  /// @throws std::invalid_argument beyond 65535 schemas, or channels
  std::uint16_t addSchema(std::string_view name, std::string_view encoding, std::string_view text);
  /// @param encoding of the messages, e.g. "cdr" @returns its number
  std::uint16_t addChannel(std::uint16_t schema, std::string_view topic, std::string_view encoding,
                           const std::map<std::string, std::string>& metadata);
  /// @param time [ns since 1970] @pre the channel was added
  void write(std::uint16_t channel, std::uint64_t time, std::string_view message);
  /// A file within the file.
  void attach(std::string_view name, std::string_view mediaType, std::string_view bytes);
  /// Writes the summary; nothing may follow. Without it the file is unfinished.
  void finish();
  std::uint64_t messages() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::ros2

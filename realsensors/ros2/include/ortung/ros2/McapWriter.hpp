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

/// Writes an MCAP file (mcap.dev/spec, version 0) front to back: messages in chunks, each with an
/// index, and a summary at the end by which a reader finds any time of any channel. All parts have
/// checksums. An unfinished file is readable up to its last complete chunk.
/// Not thread-safe.
class ORTUNG_API McapWriter {
 public:
  struct Options {
    std::string profile = "ros2";                          ///< profile: conventions of the messages
    McapCompression compression = McapCompression::kZstd;  ///< compression of chunks
    std::size_t chunkBytes = 1U << 20;  ///< size of an unpacked chunk at which it ends [bytes]
    bool isChunked = true;              ///< whether messages are in chunks, not one by one
  };
  /// Gets the file's bytes in their order; its exceptions are passed on.
  using Sink = std::function<void(std::string_view)>;

  /// Writes the beginning of a file.
  McapWriter(Sink sink, Options options);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Adds the definition of a type.
  /// @param encoding form of the text, e.g. "ros2msg"
  /// @returns the schema's number
  /// @throws std::invalid_argument beyond 65535 schemas
  std::uint16_t addSchema(std::string_view name, std::string_view encoding, std::string_view text);
  /// Adds a channel.
  /// @param schema number of its messages' type
  /// @param encoding encoding of the messages, e.g. "cdr"
  /// @returns the channel's number
  /// @throws std::invalid_argument beyond 65535 channels
  std::uint16_t addChannel(std::uint16_t schema, std::string_view topic, std::string_view encoding,
                           const std::map<std::string, std::string>& metadata);
  /// Writes a message. @param time [ns since 1970] @pre the channel was added
  void write(std::uint16_t channel, std::uint64_t time, std::string_view message);
  /// Writes an attachment: a file within the file.
  void attach(std::string_view name, std::string_view mediaType, std::string_view bytes);
  /// Writes the summary. Without this call the file is unfinished; afterwards nothing may be
  /// written.
  void finish();
  /// Number of messages written.
  std::uint64_t messages() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::ros2

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

// The only place that knows zstd (RFC 8878).
namespace ortung::zstd {

/// Makes frames that carry their size and a checksum. Not thread-safe.
class Packer {
 public:
  explicit Packer(int level);
  ~Packer();
  /// Appends @p bytes as a frame. @returns the frame's size
  std::size_t pack(std::string_view bytes, std::string& out);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// Unpacks frames of bytes that nobody vouches for. Not thread-safe.
class Unpacker {
 public:
  Unpacker();
  ~Unpacker();
  /// Unpacks a frame to which mayHold() has no objection. @p out is as large as what it must hold
  /// @returns why not, or ""
  std::string unpack(std::string_view frame, std::span<char> out);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// How many bytes the frame says that it holds, or 2^64 - 1.
std::uint64_t contentSize(std::string_view frame);
/// Why the frame can't hold so many bytes, without unpacking it; "": it may.
std::string mayHold(std::string_view frame, std::size_t size);

/// What programs of zstd pass over: eight bytes, then @p size others.
inline constexpr std::size_t kSkippableHead = 8;
/// @param variant of the sixteen kinds, which are for whoever writes them
std::string skippableHead(int variant, std::size_t size);

}  // namespace ortung::zstd

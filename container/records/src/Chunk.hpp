#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Zstd.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/records/RecordEnd.hpp"

// What a compressed record is made of (docs/files.md). All of it is frames of zstd; those that
// hold no lines are skippable, so that zstdcat prints the lines.
namespace ortung::chunk {

inline constexpr std::string_view kMagic = "ortung record 2\n";
/// Begin of the note "# binary STAMP ID WORDS STRIDE".
inline constexpr std::string_view kApartNote = "# binary ";
inline constexpr std::size_t kMaxTextWords = 4096;  ///< most words of a reading that is a line
inline constexpr std::size_t kMaxTextBytes = kMaxLineBytes;  ///< lines of a chunk

/// What stands before a chunk.
struct Head {
  Timestamp first = 0;         ///< stamp of its first reading
  Timestamp last = 0;          ///< stamp of its last reading
  std::uint32_t readings = 0;  ///< number of readings; zero: the chunk has notes alone
  std::uint32_t apart = 0;     ///< readings that are not among the lines, but behind them
  std::uint64_t textBytes = 0;
  std::uint64_t packedBytes = 0;  ///< size of the frame with the lines [bytes]
  std::uint64_t apartBytes = 0;   ///< size of the frames with readings behind it [bytes]
  bool operator==(const Head&) const = default;
};

/// Where a chunk with readings begins.
struct Place {
  std::uint64_t offset = 0;
  Timestamp first = 0;
};

/// The bytes a record begins with.
std::string magic();
/// Whether the file looks like that; its place stays. @throws std::runtime_error if it can't be
/// read
bool begins(const std::filesystem::path& file, std::istream& in);
std::string write(const Head& head, zstd::Packer& packer);
std::string write(const std::vector<Place>& index, std::uint64_t begin, zstd::Packer& packer);
/// Appends the words of one reading. @returns how far apart the bytes are whose differences it
/// wrote
std::uint32_t writeApart(std::span<const std::uint32_t> words, zstd::Packer& packer,
                         std::string& out);

/// Reads frames off a file or a pipe. Whatever is wrong is thrown as std::runtime_error, but an end
/// within a frame, which is torn().
class Frames {
 public:
  /// @throws std::runtime_error also if it does not begin as a compressed record
  Frames(std::filesystem::path file, std::ifstream in);

  /// The head of the next chunk; nothing at the end, or where it is torn.
  std::optional<Head> head();
  /// Whether the whole chunk is there, as far as that can be known; else it is torn.
  bool isWhole(const Head& head);
  /// The lines of the chunk whose head came last; false if it is torn.
  bool text(const Head& head, std::string& lines);
  /// The next reading behind the lines; false if it is torn.
  /// @param words, stride as its note says
  bool apart(std::size_t words, std::uint32_t stride, std::vector<std::uint32_t>& out);
  /// Passes over the rest of the chunk; false if it is torn.
  bool skip(std::uint64_t bytes);
  /// Goes on at a chunk, as if nothing before had been read.
  void jump(std::uint64_t chunk);
  /// What a writer that came to its end has left, if it is there. The place stays.
  std::optional<std::vector<Place>> index();

  std::uint64_t offset() const { return offset_; }
  std::uint64_t chunkBegin() const { return chunk_; }
  std::uint64_t size() const { return size_; }  ///< size of a file when it was opened [bytes]
  bool isFile() const { return isFile_; }
  /// What follows the last whole chunk, once it was come across.
  const std::optional<TornRecord>& torn() const { return torn_; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void seek(std::uint64_t offset);
  bool read(std::uint64_t count, std::string& out);
  bool tear();
  bool tearIfNothing(std::string_view begin);

  std::filesystem::path file_;
  std::ifstream in_;
  zstd::Unpacker unpacker_;
  std::string bytes_;
  std::string unpacked_;
  bool isFile_ = false;
  std::uint64_t size_ = 0;
  std::uint64_t offset_ = 0;
  std::uint64_t chunk_ = 0;  ///< offset of the present chunk in the file
  std::optional<TornRecord> torn_;
};

}  // namespace ortung::chunk

#include <algorithm>
#include <bit>
#include <cerrno>
#include <stdexcept>
#include <utility>

#include "Bytes.hpp"
#include "Chunk.hpp"
#include "ChunkTags.hpp"
#include "ortung/base/InputFile.hpp"

namespace ortung::chunk {
namespace {

constexpr std::size_t kFields = 48;           ///< bytes of a head
constexpr std::size_t kMostHead = 128;        ///< most bytes of the frame around a head
constexpr std::uint64_t kSmallestChunk = 40;  ///< lower bound for the size of a chunk [bytes]
constexpr std::size_t kPlaceBytes = 16;
constexpr std::size_t kPiece = 1u << 20;
/// Restores bytes of which writeApart() has made differences.
void fromSteps(std::span<char> bytes, std::uint32_t stride) {
  if (stride == 0) return;
  for (std::size_t i = stride; i < bytes.size(); ++i)
    bytes[i] = static_cast<char>(bytes[i] + bytes[i - stride]);
}

/// Returns the largest size that zstd makes of bytes that can't be compressed.
constexpr std::uint64_t packedAtMost(std::uint64_t bytes) { return bytes + bytes / 128 + 1024; }

}  // namespace

bool begins(const std::filesystem::path& file, std::istream& in) {
  const auto first = in.peek();
  if (in.bad()) throw std::runtime_error(file.string() + ": " + cantBeRead(errno));
  return first == static_cast<unsigned char>(magic().front());
}

Frames::Frames(std::filesystem::path file, std::ifstream in)
    : file_(std::move(file)), in_(std::move(in)) {
  isFile_ = std::filesystem::is_regular_file(file_);
  if (isFile_) size_ = std::filesystem::file_size(file_);
  std::string found;
  const std::string expected = magic();
  if (!read(expected.size(), found) || found != expected)
    throw std::runtime_error(file_.string() + ": found " + inQuotation(found) +
                             ", expected a record");
  chunk_ = offset_;
}

void Frames::fail(const std::string& what) const {
  throw std::runtime_error(file_.string() + ": the chunk at byte " + std::to_string(chunk_) + " " +
                           what);
}

/// Reads the next @p count bytes into @p out, or as many as there are; then it returns false.
/// Memory grows with the bytes that are there, not with @p count, which may be false.
bool Frames::read(std::uint64_t count, std::string& out) {
  out.clear();
  while (out.size() < count) {
    const std::size_t before = out.size();
    const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, count - before));
    out.resize(before + piece);
    in_.read(out.data() + before, static_cast<std::streamsize>(piece));
    const auto got = static_cast<std::size_t>(in_.gcount());
    if (in_.bad()) throw std::runtime_error(file_.string() + ": " + cantBeRead(errno));
    out.resize(before + got);
    offset_ += got;
    if (got < piece) return false;
  }
  return true;
}

bool Frames::tear() {
  if (offset_ > chunk_) torn_ = TornRecord{chunk_, std::max(offset_, size_) - chunk_};
  return false;
}

/// Treats a rest of zeros as torn: after a power failure a file may be longer than its written
/// bytes.
bool Frames::tearIfNothing(std::string_view begin) {
  const auto isNothing = [](std::string_view bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == 0; });
  };
  if (!isNothing(begin)) return false;
  std::string more;
  bool isMore = true;
  while (isMore) {
    isMore = read(kPiece, more);
    if (!isNothing(more)) return false;
  }
  tear();
  return true;
}

std::optional<Head> Frames::head() {
  if (torn_) return std::nullopt;
  chunk_ = offset_;
  if (!read(zstd::kSkippableHead, bytes_)) {
    tear();
    return std::nullopt;
  }
  std::string_view start = bytes_;
  const bool isOurs = start.starts_with(zstd::skippableHead(kOfOrtung, 0).substr(0, 4));
  start.remove_prefix(4);
  const auto size = takeNumber<std::uint32_t>(start);
  if (!isOurs) {
    if (tearIfNothing(bytes_)) return std::nullopt;
    fail("has no head");
  }
  if (!read(std::min<std::uint64_t>(size, kIndexTag.size()), bytes_)) {
    tear();
    return std::nullopt;
  }
  if (bytes_ == kIndexTag) {
    if (!skip(size - kIndexTag.size())) return std::nullopt;
    if (in_.peek() != std::char_traits<char>::eof()) fail("is not the last, but the index");
    return std::nullopt;
  }
  if (bytes_ != kChunkTag || size > kMostHead) fail("has no head");
  if (!read(size - kChunkTag.size(), bytes_)) {
    tear();
    return std::nullopt;
  }
  char fields[kFields];
  std::string why = zstd::mayHold(bytes_, kFields);
  if (why.empty()) why = unpacker_.unpack(bytes_, fields);
  if (!why.empty()) fail("has a head that " + why);
  std::string_view rest(fields, kFields);
  Head head;
  head.first = takeNumber<Timestamp>(rest);
  head.last = takeNumber<Timestamp>(rest);
  head.readings = takeNumber<std::uint32_t>(rest);
  head.apart = takeNumber<std::uint32_t>(rest);
  head.textBytes = takeNumber<std::uint64_t>(rest);
  head.packedBytes = takeNumber<std::uint64_t>(rest);
  head.apartBytes = takeNumber<std::uint64_t>(rest);
  if (head.textBytes > kMaxTextBytes)
    fail("says that it holds " + std::to_string(head.textBytes) + " bytes, expected at most " +
         std::to_string(kMaxTextBytes));
  if (head.packedBytes > packedAtMost(head.textBytes) || head.apart > head.readings ||
      head.first > head.last ||
      head.apartBytes > head.apart * packedAtMost(sizeof(std::uint32_t) * kMaxWords))
    fail("has a head that contradicts itself");
  return head;
}

bool Frames::isWhole(const Head& head) {
  const std::uint64_t end = offset_ + head.packedBytes + head.apartBytes;
  if (!isFile_ || end <= size_) return true;
  size_ = std::filesystem::file_size(file_);  // it may have grown
  if (end <= size_) return true;
  offset_ = size_;
  return tear();
}

bool Frames::text(const Head& head, std::string& lines) {
  if (!read(head.packedBytes, bytes_)) return tear();
  const auto size = static_cast<std::size_t>(head.textBytes);
  std::string why = zstd::mayHold(bytes_, size);
  if (why.empty()) {
    lines.resize(size);
    why = unpacker_.unpack(bytes_, lines);
  }
  if (!why.empty()) fail(why);
  return true;
}

bool Frames::apart(std::size_t words, std::uint32_t stride, std::vector<std::uint32_t>& out) {
  if (!read(zstd::kSkippableHead, bytes_)) return tear();
  std::string_view start = bytes_;
  const bool isOne = start.starts_with(zstd::skippableHead(kApart, 0).substr(0, 4));
  start.remove_prefix(4);
  const auto packed = takeNumber<std::uint32_t>(start);
  const std::size_t size = sizeof(std::uint32_t) * words;
  if (!isOne || packed > packedAtMost(size)) fail("lacks a reading that it announces");
  if (!read(packed, bytes_)) return tear();
  std::string why = zstd::mayHold(bytes_, size);
  if (why.empty()) {
    out.resize(words);
    why = unpacker_.unpack(bytes_, {reinterpret_cast<char*>(out.data()), size});
  }
  if (!why.empty()) fail("has a reading that " + why);
  fromSteps({reinterpret_cast<char*>(out.data()), size}, stride);
  if constexpr (std::endian::native == std::endian::big)
    for (std::uint32_t& word : out) word = __builtin_bswap32(word);
  return true;
}

bool Frames::skip(std::uint64_t bytes) {
  if (isFile_) {
    const std::uint64_t left = size_ - std::min(size_, offset_);
    if (bytes > left) {
      offset_ = size_;
      return tear();
    }
    seek(offset_ + bytes);
    return true;
  }
  while (bytes > 0) {
    const std::uint64_t piece = std::min<std::uint64_t>(kPiece, bytes);
    if (!read(piece, bytes_)) return tear();
    bytes -= piece;
  }
  return true;
}

void Frames::seek(std::uint64_t offset) {
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(offset));
  offset_ = offset;
}

void Frames::jump(std::uint64_t chunk) {
  seek(chunk);
  torn_.reset();
}

std::optional<std::vector<Place>> Frames::index() {
  const std::uint64_t smallest = zstd::kSkippableHead + kIndexTag.size() + 8 + kIndexEnd.size();
  if (!isFile_ || size_ < magic().size() + smallest) return std::nullopt;
  const std::uint64_t back = std::exchange(offset_, size_ - 8 - kIndexEnd.size());
  std::vector<Place> places;
  const auto readIt = [&]() -> bool {
    seek(offset_);
    if (!read(8 + kIndexEnd.size(), bytes_) || !bytes_.ends_with(kIndexEnd)) return false;
    std::string_view number = bytes_;
    const auto begin = takeNumber<std::uint64_t>(number);
    if (begin > size_ - smallest) return false;
    seek(begin);
    if (!read(size_ - begin, bytes_)) return false;
    const std::size_t head = zstd::kSkippableHead + kIndexTag.size();
    if (!bytes_.starts_with(zstd::skippableHead(kOfOrtung, bytes_.size() - zstd::kSkippableHead) +
                            std::string(kIndexTag)))
      return false;
    const std::string_view packed = std::string_view(bytes_).substr(head, bytes_.size() - smallest);
    const std::uint64_t size = zstd::contentSize(packed);
    if (size % kPlaceBytes != 0 || size / kPlaceBytes > size_ / kSmallestChunk ||
        !zstd::mayHold(packed, size).empty())
      return false;
    std::string entries(size, 0);
    if (!unpacker_.unpack(packed, entries).empty()) return false;
    for (std::string_view rest = entries; !rest.empty();) {
      const auto offset = takeNumber<std::uint64_t>(rest);
      const auto first = takeNumber<Timestamp>(rest);
      const bool isInOrder =
          places.empty() || (offset > places.back().offset && first >= places.back().first);
      if (offset < magic().size() || offset >= begin || !isInOrder) return false;
      places.push_back({offset, first});
    }
    return true;
  };
  const bool isThere = readIt();
  seek(back);
  if (!isThere) return std::nullopt;
  return places;
}

}  // namespace ortung::chunk

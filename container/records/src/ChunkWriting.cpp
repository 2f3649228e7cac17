#include "Bytes.hpp"
#include "Chunk.hpp"
#include "ChunkTags.hpp"

namespace ortung::chunk {
namespace {

std::string frame(int variant, std::string_view tag, std::string_view content) {
  std::string out = zstd::skippableHead(variant, tag.size() + content.size());
  out += tag;
  out += content;
  return out;
}

/// Subtracts from each byte the one @p stride before it, modulo 256, since neighbouring pixels are
/// alike.
void toSteps(std::span<char> bytes, std::uint32_t stride) {
  if (stride == 0) return;
  for (std::size_t i = bytes.size(); i-- > stride;)
    bytes[i] = static_cast<char>(bytes[i] - bytes[i - stride]);
}

/// Returns the stride that compresses a piece of the middle best; 0: without differences.
std::uint32_t bestStride(std::string_view bytes, zstd::Packer& packer) {
  constexpr std::size_t kPiece = 16U << 10;
  const std::string_view piece =
      bytes.substr(bytes.size() > kPiece ? (bytes.size() - kPiece) / 2 : 0, kPiece);
  std::uint32_t best = 0;
  std::size_t least = bytes.size() + kPiece;
  for (const std::uint32_t stride : kStrides) {
    std::string steps(piece);
    std::string packed;
    toSteps(steps, stride);
    const std::size_t size = packer.pack(steps, packed);
    if (size >= least) continue;
    least = size;
    best = stride;
  }
  return best;
}

}  // namespace

std::string magic() { return frame(kOfOrtung, "", kMagic); }

std::string write(const Head& head, zstd::Packer& packer) {
  std::string fields;
  putNumber(fields, head.first);
  putNumber(fields, head.last);
  putNumber(fields, head.readings);
  putNumber(fields, head.apart);
  putNumber(fields, head.textBytes);
  putNumber(fields, head.packedBytes);
  putNumber(fields, head.apartBytes);
  std::string packed;
  packer.pack(fields, packed);
  return frame(kOfOrtung, kChunkTag, packed);
}

std::string write(const std::vector<Place>& index, std::uint64_t begin, zstd::Packer& packer) {
  std::string entries;
  for (const Place& place : index) {
    putNumber(entries, place.offset);
    putNumber(entries, place.first);
  }
  std::string packed;
  packer.pack(entries, packed);
  putNumber(packed, begin);
  packed += kIndexEnd;
  return frame(kOfOrtung, kIndexTag, packed);
}

std::uint32_t writeApart(std::span<const std::uint32_t> words, zstd::Packer& packer,
                         std::string& out) {
  std::string bytes(sizeof(std::uint32_t) * words.size(), 0);
  putWords(words, bytes);
  const std::uint32_t stride = bestStride(bytes, packer);
  toSteps(bytes, stride);
  std::string packed;
  packer.pack(bytes, packed);
  out += zstd::skippableHead(kApart, packed.size());
  out += packed;
  return stride;
}

}  // namespace ortung::chunk

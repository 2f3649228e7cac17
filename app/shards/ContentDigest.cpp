#include "ContentDigest.hpp"

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "ortung/base/InputFile.hpp"

namespace ortung::app {

struct ContentDigest::State {
  XXH3_state_t hash;
};

ContentDigest::ContentDigest() : state_(std::make_unique<State>()) {
  XXH3_128bits_reset(&state_->hash);
}

ContentDigest::~ContentDigest() = default;

void ContentDigest::add(std::span<const std::byte> bytes) {
  XXH3_128bits_update(&state_->hash, bytes.data(), bytes.size());
}

void ContentDigest::add(std::string_view text) {
  const std::uint64_t size = text.size();
  add(std::as_bytes(std::span(&size, 1)));
  add(std::as_bytes(std::span(text)));
}

std::string ContentDigest::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(&state_->hash);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string digestOfFile(const std::filesystem::path& file) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) throw std::runtime_error(file.string() + ": " + why);
  ContentDigest digest;
  std::vector<char> piece(kPiece);
  while (in) {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    digest.add(std::as_bytes(std::span(piece).first(static_cast<std::size_t>(in.gcount()))));
  }
  if (in.bad()) throw std::runtime_error(file.string() + ": can't be read to its end");
  return digest.text();
}

}  // namespace ortung::app

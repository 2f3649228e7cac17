#include "ortung/container/Random.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace ortung {
namespace {

struct Block {
  std::uint32_t words[4];
};

/// Philox4x32-10 of a 128-bit counter (block, stream) and a 64-bit key.
inline Block philox(std::uint64_t key, std::uint64_t stream, std::uint64_t block) {
  std::uint32_t c0 = static_cast<std::uint32_t>(block);
  std::uint32_t c1 = static_cast<std::uint32_t>(block >> 32);
  std::uint32_t c2 = static_cast<std::uint32_t>(stream);
  std::uint32_t c3 = static_cast<std::uint32_t>(stream >> 32);
  std::uint32_t k0 = static_cast<std::uint32_t>(key);
  std::uint32_t k1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53U} * c0;
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57U} * c2;
    c0 = static_cast<std::uint32_t>(p1 >> 32) ^ c1 ^ k0;
    c1 = static_cast<std::uint32_t>(p1);
    c2 = static_cast<std::uint32_t>(p0 >> 32) ^ c3 ^ k1;
    c3 = static_cast<std::uint32_t>(p0);
    k0 += 0x9E3779B9U;
    k1 += 0xBB67AE85U;
  }
  return {{c0, c1, c2, c3}};
}

/// In [0, 1), 24 bits, exact in a float.
inline float unit(std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24F; }

/// Two Gaussian numbers from two words (Box and Muller, 1958).
inline void boxMuller(std::uint32_t a, std::uint32_t b, float& first, float& second) {
  const float radius = std::sqrt(-2.0F * std::log(unit(a) + 0x1p-25F));  // never ln 0
  const float angle = 2.0F * std::numbers::pi_v<float> * unit(b);
  first = radius * std::cos(angle);
  second = radius * std::sin(angle);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}

void Random::refill() {
  const Block block = philox(seed_, stream_, block_++);
  for (int i = 0; i < 4; ++i) words_[i] = block.words[i];
  used_ = 0;
}

std::uint32_t Random::next() {
  if (used_ == 4) refill();
  return words_[used_++];
}

double Random::uniform() {
  const std::uint64_t high = next();
  return static_cast<double>(((high << 32) | next()) >> 11) * 0x1p-53;
}

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

std::uint64_t Random::below(std::uint64_t n) {
  assert(n > 0);
  return static_cast<std::uint64_t>(uniform() * static_cast<double>(n));
}

double Random::gaussian() {
  if (hasSpare_) {
    hasSpare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  spare_ = radius * std::sin(angle);
  hasSpare_ = true;
  return radius * std::cos(angle);
}

Random Random::fork(std::uint64_t stream) const {
  // Mixed through the generator itself, so that forks of forks do not collide.
  const Block mixed = philox(seed_, stream_ ^ 0x9E3779B97F4A7C15ULL, stream);
  return Random(seed_, (std::uint64_t{mixed.words[0]} << 32) | mixed.words[1]);
}

void fillUniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                 std::span<float> out) {
  std::size_t i = 0;
  while (i < out.size()) {
    const std::uint64_t place = first + i;
    const Block block = philox(seed, stream, place / 4);
    for (std::size_t k = place % 4; k < 4 && i < out.size(); ++k) out[i++] = unit(block.words[k]);
  }
}

void fillGaussian(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                  std::span<float> out) {
  assert(first % 2 == 0);
  std::size_t i = 0;
  while (i < out.size()) {
    const std::uint64_t place = first + i;
    const Block block = philox(seed, stream, place / 4);
    for (std::size_t k = place % 4; k < 4 && i < out.size(); k += 2) {
      float a = 0.0F;
      float b = 0.0F;
      boxMuller(block.words[k], block.words[k + 1], a, b);
      out[i++] = a;
      if (i < out.size()) out[i++] = b;
    }
  }
}

}  // namespace ortung

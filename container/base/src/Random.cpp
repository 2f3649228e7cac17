#include "ortung/base/Random.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "ortung/base/Angles.hpp"
#include "ortung/base/FastMath.hpp"
#include "ortung/base/GaussianRows.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

/// A block of four words of 32 bits. A wider Word has anything above these bits.
template <class Word>
struct Block {
  Word words[4];
};

template <class Word>
ORTUNG_INLINE std::uint32_t low(Word word) {
  return static_cast<std::uint32_t>(word);
}

template <class Word>
ORTUNG_INLINE void round(Block<Word>& c, std::uint32_t k0, std::uint32_t k1) {
  const std::uint64_t p0 = std::uint64_t{0xD2511F53U} * low(c.words[0]);
  const std::uint64_t p1 = std::uint64_t{0xCD9E8D57U} * low(c.words[2]);
  c = {{static_cast<Word>(p1 >> 32) ^ c.words[1] ^ k0, static_cast<Word>(p1),
        static_cast<Word>(p0 >> 32) ^ c.words[3] ^ k1, static_cast<Word>(p0)}};
}

/// Philox4x32-10 of a 128-bit counter (block, stream) and a 64-bit key. Without a loop, so that
/// loops over blocks vectorize.
/// @tparam Word words of 64 bits take the place of the products, so that these are never packed and
///   unpacked; words of 32 bits suit machines that can't multiply vectors of 64 bits
template <class Word>
ORTUNG_INLINE Block<Word> philox(std::uint64_t key, std::uint64_t stream, std::uint64_t block) {
  constexpr std::uint32_t kW0 = 0x9E3779B9U;
  constexpr std::uint32_t kW1 = 0xBB67AE85U;
  const auto k0 = static_cast<std::uint32_t>(key);
  const auto k1 = static_cast<std::uint32_t>(key >> 32);
  Block<Word> c{{static_cast<Word>(block), static_cast<Word>(block >> 32),
                 static_cast<Word>(stream), static_cast<Word>(stream >> 32)}};
  round(c, k0, k1);
  round(c, k0 + kW0, k1 + kW1);
  round(c, k0 + 2 * kW0, k1 + 2 * kW1);
  round(c, k0 + 3 * kW0, k1 + 3 * kW1);
  round(c, k0 + 4 * kW0, k1 + 4 * kW1);
  round(c, k0 + 5 * kW0, k1 + 5 * kW1);
  round(c, k0 + 6 * kW0, k1 + 6 * kW1);
  round(c, k0 + 7 * kW0, k1 + 7 * kW1);
  round(c, k0 + 8 * kW0, k1 + 8 * kW1);
  round(c, k0 + 9 * kW0, k1 + 9 * kW1);
  return c;
}

/// Returns a number in [0, 1) of 24 bits, exact in a float. (It converts a signed number, which is
/// a single instruction.)
ORTUNG_INLINE float unit(std::uint32_t word) {
  return static_cast<float>(static_cast<std::int32_t>(word >> 8)) * 0x1p-24F;
}

struct Pair {
  float first;
  float second;
};

/// Makes two Gaussian numbers of two words (Box and Muller, 1958).
ORTUNG_INLINE Pair boxMuller(std::uint32_t a, std::uint32_t b) {
  const float radius = std::sqrt(-2.0F * naturalLog(unit(a) + 0x1p-25F));  // never ln 0
  const SinCos angle = sinCos(kTurnFloat * unit(b));
  return {radius * angle.cos, radius * angle.sin};
}

constexpr std::size_t kNumbersABlock = 4;
constexpr std::size_t kBlocksAGroup = 16;  ///< vectors of every width divide it
constexpr std::size_t kNumbersAGroup = kNumbersABlock * kBlocksAGroup;

/// The four Gaussian numbers of a block.
template <class Word>
ORTUNG_INLINE std::array<float, kNumbersABlock> gaussianBlock(std::uint64_t seed,
                                                              std::uint64_t stream,
                                                              std::uint64_t block) {
  const Block<Word> c = philox<Word>(seed, stream, block);
  const Pair first = boxMuller(low(c.words[0]), low(c.words[1]));
  const Pair second = boxMuller(low(c.words[2]), low(c.words[3]));
  return {first.first, first.second, second.first, second.second};
}

/// Fills whole groups of blocks from @p block on.
template <class Word>
struct UniformGroups {
  ORTUNG_INLINE static void run(std::uint64_t seed, std::uint64_t stream, std::uint64_t block,
                                std::size_t groups, float* out) {
    for (std::size_t g = 0; g < groups; ++g) {
      for (std::size_t lane = 0; lane < kBlocksAGroup; ++lane) {
        const Block c = philox<Word>(seed, stream, block + g * kBlocksAGroup + lane);
        float* numbers = out + g * kNumbersAGroup + lane * kNumbersABlock;
        for (std::size_t w = 0; w < kNumbersABlock; ++w) numbers[w] = unit(low(c.words[w]));
      }
    }
  }
};

template <class Word>
struct GaussianGroups {
  ORTUNG_INLINE static void run(std::uint64_t seed, std::uint64_t stream, std::uint64_t block,
                                std::size_t groups, float* out) {
    for (std::size_t g = 0; g < groups; ++g) {
      for (std::size_t lane = 0; lane < kBlocksAGroup; ++lane) {
        const auto its = gaussianBlock<Word>(seed, stream, block + g * kBlocksAGroup + lane);
        float* numbers = out + g * kNumbersAGroup + lane * kNumbersABlock;
        for (std::size_t w = 0; w < kNumbersABlock; ++w) numbers[w] = its[w];
      }
    }
  }
};

/// Fills a row with each of the four numbers of the blocks from @p block on.
template <class Word>
struct GaussianColumns {
  ORTUNG_INLINE static void run(std::uint64_t seed, std::uint64_t stream, std::uint64_t block,
                                std::size_t n, float* __restrict row0, float* __restrict row1,
                                float* __restrict row2, float* __restrict row3) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto numbers = gaussianBlock<Word>(seed, stream, block + i);
      row0[i] = numbers[0];
      row1[i] = numbers[1];
      row2[i] = numbers[2];
      row3[i] = numbers[3];
    }
  }
};

/// Runs a loop with the words that suit the instruction set.
template <template <class Word> class Loop, class... Arguments>
void runWidestWords(Arguments... arguments) {
  if (instructionSet() == InstructionSet::kAvx512)
    runWidest<Loop<std::uint64_t>>(arguments...);
  else
    runWidest<Loop<std::uint32_t>>(arguments...);
}

/// Fills @p out from number @p first of the stream on: whole groups in place, its ends by way of a
/// buffer.
template <template <class Word> class Groups>
void fill(std::uint64_t seed, std::uint64_t stream, std::uint64_t first, std::span<float> out) {
  std::array<float, kNumbersAGroup> spare;
  while (!out.empty()) {
    const std::size_t skipped = first % kNumbersABlock;
    std::size_t done = out.size() / kNumbersAGroup * kNumbersAGroup;
    if (skipped == 0 && done > 0) {
      runWidestWords<Groups>(seed, stream, first / kNumbersABlock, done / kNumbersAGroup,
                             out.data());
    } else {
      // A start in the middle of a block goes only up to the block's end, so that the rest is
      // written in place.
      done = std::min(out.size(), skipped == 0 ? kNumbersAGroup : kNumbersABlock - skipped);
      runWidestWords<Groups>(seed, stream, first / kNumbersABlock, 1, spare.data());
      std::copy_n(spare.begin() + static_cast<std::ptrdiff_t>(skipped), done, out.begin());
    }
    first += done;
    out = out.subspan(done);
  }
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}

void Random::refill() {
  const auto block = philox<std::uint32_t>(seed_, stream_, block_++);
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
  const double angle = kTurn * uniform();
  spare_ = radius * std::sin(angle);
  hasSpare_ = true;
  return radius * std::cos(angle);
}

Random Random::fork(std::uint64_t stream) const {
  // Mixed through the generator itself, so that forks of forks do not collide.
  const auto mixed = philox<std::uint32_t>(seed_, stream_ ^ 0x9E3779B97F4A7C15ULL, stream);
  return Random(seed_, (std::uint64_t{mixed.words[0]} << 32) | mixed.words[1]);
}

void fillUniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                 std::span<float> out) {
  fill<UniformGroups>(seed, stream, first, out);
}

void fillGaussian(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                  std::span<float> out) {
  assert(first % 2 == 0);
  fill<GaussianGroups>(seed, stream, first, out);
}

void fillGaussianRows(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                      const std::array<std::span<float>, 4>& rows) {
  runWidestWords<GaussianColumns>(seed, stream, first, rows[0].size(), rows[0].data(),
                                  rows[1].data(), rows[2].data(), rows[3].data());
}

}  // namespace ortung

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "ScanCost.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr std::array kSets{InstructionSet::kPortable, InstructionSet::kAvx2,
                           InstructionSet::kAvx512, InstructionSet::kNeon};

struct Problem {
  std::vector<std::uint8_t> levels;
  std::vector<std::uint8_t> caps;
  std::vector<std::uint8_t> steps;  ///< none for every second problem
  std::vector<std::uint8_t> table;  ///< rows lie in it at odd places
  std::vector<const std::uint8_t*> rows;
  ScanReading reading;
};

/// Random numbers of three kinds: any, near each other, and the extremes only.
Problem makeProblem(std::size_t blocks, std::size_t rows, std::uint64_t seed) {
  Random random(seed);
  const auto kind = random.below(3);
  const auto byte = [&]() -> std::uint8_t {
    if (kind == 0) return static_cast<std::uint8_t>(random.below(256));
    if (kind == 1) return static_cast<std::uint8_t>(100 + random.below(40));
    return random.below(2) == 0 ? 0 : 255;
  };
  Problem p;
  const std::size_t n = blocks * kScanBlock;
  p.levels.resize(n);
  p.caps.resize(n);
  p.table.resize(n + rows * 7 + 1);
  std::generate(p.levels.begin(), p.levels.end(), byte);
  std::generate(p.table.begin(), p.table.end(), byte);
  for (std::uint8_t& cap : p.caps)
    cap = random.below(4) == 0 ? 0 : static_cast<std::uint8_t>(random.below(256));
  for (std::size_t i = 0; i < rows; ++i) p.rows.push_back(p.table.data() + 1 + 7 * i);
  if (seed % 2 != 0) {
    const bool isWide = random.below(2) == 0;  // or few kinds, as scans have
    for (std::size_t j = 0; j < n; ++j)
      p.steps.push_back(
          static_cast<std::uint8_t>(isWide ? random.below(128) : 127 - 20 * random.below(3)));
  }
  p.reading = {p.levels, p.caps, p.steps, static_cast<int>(random.below(kMostShift + 1)), {}};
  for (std::uint8_t& cost : p.reading.costs) cost = static_cast<std::uint8_t>(random.below(256));
  std::sort(p.reading.costs.begin(), p.reading.costs.end());
  return p;
}

/// The formula of the header, word for word.
std::vector<std::uint32_t> reference(const Problem& p) {
  std::vector<std::uint32_t> sums;
  for (const std::uint8_t* row : p.rows) {
    std::uint32_t sum = 0;
    for (std::size_t j = 0; j < p.levels.size(); ++j) {
      const int difference = std::abs(static_cast<int>(row[j]) - static_cast<int>(p.levels[j]));
      const double step = p.steps.empty() ? 1.0 : std::ldexp(p.steps[j], -p.reading.shift);
      const double steps = std::floor(std::min(difference * step, 1e3) + 0.5);
      sum += std::min<std::uint32_t>(
          p.caps[j], p.reading.costs[static_cast<std::size_t>(std::min(31.0, steps))]);
    }
    sums.push_back(sum);
  }
  return sums;
}

void expectEqualsReference(ScanCostKernel kernel) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Problem p = makeProblem(1 + seed % 9, seed % 67, seed);
    std::vector<std::uint32_t> costs(p.rows.size());
    kernel(p.reading, p.rows, costs.data());
    ASSERT_EQ(costs, reference(p)) << "seed " << seed;
  }
}

TEST(ScanCost, PortableEqualsTheFormula) {
  expectEqualsReference(scanCostKernel(InstructionSet::kPortable));
}

TEST(ScanCost, Avx2EqualsTheFormula) {
  const ScanCostKernel kernel = scanCostKernel(InstructionSet::kAvx2);
  if (kernel == nullptr) GTEST_SKIP() << "this machine has no AVX2";
  expectEqualsReference(kernel);
}

TEST(ScanCost, Avx512EqualsTheFormula) {
  const ScanCostKernel kernel = scanCostKernel(InstructionSet::kAvx512);
  if (kernel == nullptr) GTEST_SKIP() << "this machine has no AVX-512";
  expectEqualsReference(kernel);
}

TEST(ScanCost, TheFastestKernelEqualsTheFormula) { expectEqualsReference(scanCostKernel()); }

/// Buffers as long as the header allows and no longer, so that AddressSanitizer sees what is read
/// behind them.
struct TightProblem {
  std::vector<std::unique_ptr<std::uint8_t[]>> buffers;
  Problem p;

  std::span<std::uint8_t> make(std::size_t n) {
    buffers.push_back(std::make_unique<std::uint8_t[]>(n));
    return {buffers.back().get(), n};
  }
};

/// @param used readings that count; the rest of the last block is padding
/// @param kinds how many different pairs of cap and step occur, if there is room for them
TightProblem makeTightProblem(std::size_t used, std::size_t rows, std::size_t kinds,
                              std::uint64_t seed) {
  Random random(seed);
  TightProblem t;
  const std::size_t n = (used + kScanBlock - 1) / kScanBlock * kScanBlock;
  const auto levels = t.make(n);
  const auto caps = t.make(n);
  const auto steps = t.make(seed % 2 == 0 ? 0 : n);
  // Differences of -255 to 255: the first and last entry of every table of costs.
  const auto level = [&] {
    const auto kind = random.below(4);
    return static_cast<std::uint8_t>(kind == 0 ? 0 : kind == 1 ? 255 : random.below(256));
  };
  for (std::size_t j = 0; j < used; ++j) {
    const std::size_t kind = j % kinds;
    levels[j] = level();
    caps[j] = static_cast<std::uint8_t>(steps.empty() ? 255 - kind : 255 - kind / 2);
    if (!steps.empty()) steps[j] = static_cast<std::uint8_t>(kind % 2 == 0 ? 127 : 40);
  }
  for (std::size_t i = 0; i < rows; ++i) {
    const auto row = t.make(n);
    std::generate(row.begin(), row.end(), level);
    t.p.rows.push_back(row.data());
  }
  t.p.levels.assign(levels.begin(), levels.end());
  t.p.caps.assign(caps.begin(), caps.end());
  t.p.steps.assign(steps.begin(), steps.end());
  t.p.reading = {levels, caps, steps, static_cast<int>(random.below(kMostShift + 1)), {}};
  for (std::size_t i = 0; i < kLevelDifferences; ++i)
    t.p.reading.costs[i] = static_cast<std::uint8_t>(8 * i + 3);
  return t;
}

// The portable kernel looks costs up two at a time from 8 rows on, and for up to 16 pairs of caps;
// 512 readings at once.
TEST(ScanCost, AllKernelsEqualTheFormulaAtEverySizeWithinTheirBuffers) {
  std::vector<std::size_t> sizes;
  for (std::size_t used = 1; used <= 2 * kScanBlock + 1; ++used) sizes.push_back(used);
  sizes.insert(sizes.end(), {511, 512, 513, 1025});
  std::uint64_t seed = 0;
  for (const std::size_t used : sizes) {
    for (const std::size_t rows : {1u, 7u, 8u, 9u}) {
      for (const std::size_t kinds : {1u, 2u, 15u, 16u, 17u, 32u, 200u}) {
        const TightProblem t = makeTightProblem(used, rows, kinds, ++seed);
        const std::vector<std::uint32_t> expected = reference(t.p);
        for (const InstructionSet set : kSets) {
          const ScanCostKernel kernel = scanCostKernel(set);
          if (kernel == nullptr) continue;
          std::vector<std::uint32_t> costs(rows);
          kernel(t.p.reading, t.p.rows, costs.data());
          ASSERT_EQ(costs, expected) << "set " << static_cast<int>(set) << ", " << used
                                     << " readings, " << rows << " rows, " << kinds << " kinds";
        }
      }
    }
  }
}

// 8192 beams of the greatest cost: the largest sum that can occur.
TEST(ScanCost, DoesNotOverflow) {
  Problem p = makeProblem(128, 1, 1);
  std::fill(p.levels.begin(), p.levels.end(), 0);
  std::fill(p.table.begin(), p.table.end(), 255);
  std::fill(p.caps.begin(), p.caps.end(), 255);
  p.reading.costs.fill(255);
  for (const InstructionSet set : kSets) {
    const ScanCostKernel kernel = scanCostKernel(set);
    if (kernel == nullptr) continue;
    std::uint32_t cost = 0;
    kernel(p.reading, p.rows, &cost);
    EXPECT_EQ(cost, 8192u * 255u);
  }
}

}  // namespace
}  // namespace ortung

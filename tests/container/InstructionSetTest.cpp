// Loops compiled for several instruction sets: the variable that chooses is heeded, and all sets
// give the same bits.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "FakeRoom.hpp"
#include "ScanCost.hpp"
#include "ortung/base/GaussianRows.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

/// A set, and the word of $ORTUNG_SIMD for it on this kind of processor.
struct Choice {
  const char* word;
  InstructionSet set;
};
#ifdef ORTUNG_NEON
constexpr std::array kChoices{Choice{"portable", InstructionSet::kPortable},
                              Choice{"neon", InstructionSet::kNeon}};
constexpr const char* kWords = "portable or neon";
constexpr std::array kForeign{"avx2", "avx512"};
#else
constexpr std::array kChoices{Choice{"portable", InstructionSet::kPortable},
                              Choice{"avx2", InstructionSet::kAvx2},
                              Choice{"avx512", InstructionSet::kAvx512}};
constexpr const char* kWords = "portable, avx2 or avx512";
constexpr std::array kForeign{"neon"};
#endif

int codeOf(InstructionSet set) { return 10 + static_cast<int>(set); }

/// Ends this process with what instructionSet() chooses, if the kernel is chosen by it, too.
[[noreturn]] void exitWithChoice() {
  const InstructionSet set = instructionSet();
  std::_Exit(scanCostKernel() == scanCostKernel(set) ? codeOf(set) : 1);
}

/// @param value of $ORTUNG_SIMD, or null: not set
void expectChosen(const char* value, InstructionSet most) {
  if (value == nullptr)
    ::unsetenv("ORTUNG_SIMD");
  else
    ::setenv("ORTUNG_SIMD", value, 1);
  InstructionSet expected = InstructionSet::kPortable;
  for (const Choice& choice : kChoices)
    if (choice.set <= most && hasInstructionSet(choice.set)) expected = choice.set;
  EXPECT_EXIT(exitWithChoice(), ::testing::ExitedWithCode(codeOf(expected)), "")
      << (value == nullptr ? "not set" : value);
}

TEST(InstructionSetDeathTest, TheVariableLowersTheChoice) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a new process: the choice is made once
  for (const Choice& choice : kChoices) expectChosen(choice.word, choice.set);
  expectChosen(nullptr, kChoices.back().set);
  ::unsetenv("ORTUNG_SIMD");
}

template <class Result>
void expectSameBits(const Result& make, const std::string& what) {
  useInstructionSet(InstructionSet::kPortable);
  const auto portable = make();
  for (const auto& [word, set] : kChoices) {
    if (!hasInstructionSet(set)) continue;
    useInstructionSet(set);
    const auto found = make();
    ASSERT_EQ(found.size(), portable.size());
    if (found.empty()) continue;  // no bytes to compare, and memcmp wants some
    EXPECT_EQ(std::memcmp(found.data(), portable.data(), found.size() * sizeof found[0]), 0)
        << what << ", " << word;
  }
  useInstructionSet(std::nullopt);
}

TEST(InstructionSet, RandomNumbersAreTheSameBitsFromEveryPlaceAndOfEveryLength) {
  for (const std::size_t n : {0u, 1u, 2u, 7u, 63u, 64u, 65u, 255u, 1000u}) {
    for (const std::uint64_t first : {0u, 2u, 30u, 62u, 64u}) {
      const std::string what = std::to_string(n) + " from " + std::to_string(first);
      expectSameBits(
          [&] {
            std::vector<float> numbers(n);
            fillUniform(3, 4, first, numbers);
            return numbers;
          },
          "uniform, " + what);
      expectSameBits(
          [&] {
            std::vector<float> numbers(n);
            fillGaussian(3, 4, first, numbers);
            return numbers;
          },
          "gaussian, " + what);
    }
  }
}

TEST(InstructionSet, RowsOfGaussianNumbersAreTheSameBits) {
  for (const std::size_t n : {0u, 1u, 15u, 16u, 17u, 256u}) {
    for (const std::uint64_t first : {0u, 1u, 17u}) {
      std::vector<float> numbers(4 * n);
      fillGaussian(3, 4, 4 * first, numbers);
      expectSameBits(
          [&] {
            std::vector<float> rows(4 * n);
            const auto row = [&](std::size_t k) { return std::span(rows).subspan(k * n, n); };
            fillGaussianRows(3, 4, first, {row(0), row(1), row(2), row(3)});
            for (std::size_t i = 0; i < rows.size(); ++i)
              EXPECT_EQ(row(i % 4)[i / 4], numbers[i]) << n << " from " << first;
            return rows;
          },
          std::to_string(n) + " from " + std::to_string(first));
    }
  }
}

TEST(InstructionSet, SamplesMoveByTheSameBits) {
  const OdometryMotion motion{OdometryNoise{}};
  for (const std::size_t n : {1u, 3u, 8u, 17u, 64u, 1001u}) {
    expectSameBits(
        [&] {
          std::vector<float> numbers(3 * n);
          fillUniform(1, 2, 0, numbers);
          const std::span all(numbers);
          motion.sampleMotion({all.first(n), all.subspan(n, n), all.last(n)}, {0.3, 0.05, 0.2}, 5,
                              6, 0);
          return numbers;
        },
        std::to_string(n) + " samples");
  }
}

/// Log probabilities of samples all over a room, and outside of it.
std::vector<float> weighed(const ScanData& scan, const test::Room& room, std::size_t n) {
  std::vector<float> x(n);
  std::vector<float> y(n);
  std::vector<float> theta(n);
  Random random(9);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = static_cast<float>(random.uniform(-0.6, 0.6) * room.width);
    y[i] = static_cast<float>(random.uniform(-0.6, 0.6) * room.height);
    theta[i] = static_cast<float>(random.uniform(-4.0, 4.0));
  }
  std::vector<float> log(n, 0.0F);
  scan.getProbability(SampleView{x, y, theta}, log);
  return log;
}

TEST(InstructionSet, ScansWeighTheSameBits) {
  const test::Room room{4.0, 3.0};
  for (const int beams : {1, 31, 32, 33, 64, 90, 180}) {
    ScanData::Config config;
    config.beams = beams;
    config.firstAngle = -1.5;
    config.angleStep = 3.0 / beams;
    config.maxRange = 8.0;
    ScanData scan({"laser", "LRF", "scan"}, {}, config);
    test::learnEverywhere(scan, room.region(0.25, 0.2), 0.0349, [&](const Pose2& sensor) {
      return test::scanWords(room, sensor, config);
    });
    scan.setData(1, test::scanWords(room, {0.3, -0.4, 0.7}, config));
    for (const std::size_t n : {1u, 15u, 16u, 100u}) {
      expectSameBits([&] { return weighed(scan, room, n); },
                     std::to_string(beams) + " beams, " + std::to_string(n) + " samples");
    }
    const std::vector<float> log = weighed(scan, room, 100);
    EXPECT_NE(*std::min_element(log.begin(), log.end()), *std::max_element(log.begin(), log.end()))
        << "or all of this compares nothing";
  }
}

TEST(InstructionSet, AMisspeltChoiceIsRefusedByName) {
  for (const Choice& fine : kChoices) {
    ::setenv("ORTUNG_SIMD", fine.word, 1);
    EXPECT_NO_THROW(checkInstructionSet()) << fine.word;
  }
  ::unsetenv("ORTUNG_SIMD");
  EXPECT_NO_THROW(checkInstructionSet());
  std::vector<std::string> refused{"AVX2", "sse", ""};
  refused.insert(refused.end(), kForeign.begin(), kForeign.end());
  for (const std::string& misspelt : refused) {
    ::setenv("ORTUNG_SIMD", misspelt.c_str(), 1);
    try {
      checkInstructionSet();
      ADD_FAILURE() << misspelt;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "$ORTUNG_SIMD is '" + misspelt + "', expected " + kWords);
    }
  }
  ::unsetenv("ORTUNG_SIMD");
}

}  // namespace
}  // namespace ortung

#include "ortung/base/InstructionSet.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ortung {
namespace {

struct Choice {
  std::string_view word;  ///< of $ORTUNG_SIMD
  InstructionSet set;
};

/// The choices on this kind of processor, from the narrowest set to the widest.
#ifdef ORTUNG_NEON
constexpr std::array kChoices{Choice{"portable", InstructionSet::kPortable},
                              Choice{"neon", InstructionSet::kNeon}};
constexpr std::string_view kWords = "portable or neon";
#else
constexpr std::array kChoices{Choice{"portable", InstructionSet::kPortable},
                              Choice{"avx2", InstructionSet::kAvx2},
                              Choice{"avx512", InstructionSet::kAvx512}};
constexpr std::string_view kWords = "portable, avx2 or avx512";
#endif

constexpr int kNotForced = -1;
std::atomic<int> forced = kNotForced;

/// What the user has chosen.
std::string_view widest() {
  const char* variable = std::getenv("ORTUNG_SIMD");
  return variable == nullptr ? kChoices.back().word : variable;
}

InstructionSet choose() {
  const std::string_view most = widest();
  const auto narrower = std::find_if(kChoices.rbegin(), kChoices.rend(),
                                     [&](const Choice& c) { return c.word == most; });
  const auto best =
      std::find_if(narrower == kChoices.rend() ? kChoices.rbegin() : narrower, kChoices.rend(),
                   [](const Choice& c) { return hasInstructionSet(c.set); });
  return best->set;  // every machine has the portable one
}

}  // namespace

bool hasInstructionSet(InstructionSet set) {
  switch (set) {
    case InstructionSet::kPortable:
      return true;
#if defined(ORTUNG_X86)
    case InstructionSet::kAvx2:
      return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::kAvx512:
      return __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0;
#elif defined(ORTUNG_NEON)
    case InstructionSet::kNeon:
      return true;
#endif
    default:
      return false;
  }
}

InstructionSet instructionSet() {
  const int set = forced.load(std::memory_order_relaxed);
  if (set != kNotForced) return static_cast<InstructionSet>(set);
  static const InstructionSet kChosen = choose();
  return kChosen;
}

void checkInstructionSet() {
  const std::string_view most = widest();
  const bool isKnown = std::any_of(kChoices.begin(), kChoices.end(),
                                   [&](const Choice& choice) { return choice.word == most; });
  if (!isKnown)
    throw std::invalid_argument("$ORTUNG_SIMD is '" + std::string(most) + "', expected " +
                                std::string(kWords));
}

void useInstructionSet(std::optional<InstructionSet> set) {
  forced = set ? static_cast<int>(*set) : kNotForced;
}

}  // namespace ortung

#include "ortung/base/InstructionSet.hpp"

#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ortung {
namespace {

constexpr int kNotForced = -1;
std::atomic<int> forced = kNotForced;

/// What the user has chosen.
std::string_view widest() {
  const char* variable = std::getenv("ORTUNG_SIMD");
  return variable == nullptr ? "avx512" : variable;
}

InstructionSet choose() {
  const std::string_view most = widest();
  if (most == "avx512" && hasInstructionSet(InstructionSet::kAvx512))
    return InstructionSet::kAvx512;
  if (most != "portable" && hasInstructionSet(InstructionSet::kAvx2)) return InstructionSet::kAvx2;
  return InstructionSet::kPortable;
}

}  // namespace

bool hasInstructionSet(InstructionSet set) {
  if (set == InstructionSet::kPortable) return true;
#ifdef ORTUNG_X86
  if (set == InstructionSet::kAvx2) return __builtin_cpu_supports("avx2") != 0;
  return __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
#else
  return false;
#endif
}

InstructionSet instructionSet() {
  const int set = forced.load(std::memory_order_relaxed);
  if (set != kNotForced) return static_cast<InstructionSet>(set);
  static const InstructionSet kChosen = choose();
  return kChosen;
}

void checkInstructionSet() {
  const std::string_view most = widest();
  if (most != "portable" && most != "avx2" && most != "avx512")
    throw std::invalid_argument("$ORTUNG_SIMD is '" + std::string(most) +
                                "', expected portable, avx2 or avx512");
}

void useInstructionSet(std::optional<InstructionSet> set) {
  forced = set ? static_cast<int>(*set) : kNotForced;
}

}  // namespace ortung

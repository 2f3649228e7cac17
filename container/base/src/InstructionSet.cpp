#include "ortung/base/InstructionSet.hpp"

#include <atomic>
#include <cstdlib>
#include <string_view>

namespace ortung {
namespace {

constexpr int kNotForced = -1;
std::atomic<int> forced = kNotForced;

InstructionSet choose() {
  const char* variable = std::getenv("ORTUNG_SIMD");
  const std::string_view most = variable == nullptr ? "avx512" : variable;
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

void useInstructionSet(std::optional<InstructionSet> set) {
  forced = set ? static_cast<int>(*set) : kNotForced;
}

}  // namespace ortung

#pragma once

#include <optional>

#include "ortung/base/Export.hpp"

/// Loops are compiled for several instruction sets, and the program chooses one when it runs. All
/// give the same bits: they are whole-numbered, or use additions, multiplications and roots only,
/// which IEEE 754 rounds alike at every width (and the compiler must not fuse them:
/// -ffp-contract=off).
namespace ortung {

/// Instruction sets that loops are compiled for: on x86-64 portable, AVX2, AVX-512 from the
/// narrowest to the widest vectors, on 64-bit ARM portable and NEON. (NEON is part of every such
/// processor, so portable loops that compilers vectorize use it, too.)
enum class InstructionSet { kPortable, kAvx2, kAvx512, kNeon };

/// Returns whether this machine (and build) can run it.
ORTUNG_API bool hasInstructionSet(InstructionSet set);

/// Returns the widest set of this machine; $ORTUNG_SIMD (portable, avx2, avx512; on ARM portable,
/// neon) lowers the choice, any other word does nothing: see checkInstructionSet().
ORTUNG_API InstructionSet instructionSet();

/// Checks the environment; programs call it at their beginning.
/// @throws std::invalid_argument if $ORTUNG_SIMD is none of these words
ORTUNG_API void checkInstructionSet();

/// Makes instructionSet() give @p set, or again the widest: for tests and benchmarks, which compare
/// sets in one process. @pre hasInstructionSet(*set)
ORTUNG_API void useInstructionSet(std::optional<InstructionSet> set);

}  // namespace ortung

#if defined(__x86_64__) && defined(__GNUC__)
#define ORTUNG_X86 1
#define ORTUNG_AVX2 __attribute__((target("avx2")))
#if defined(__clang__)
#define ORTUNG_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))
#else
#define ORTUNG_AVX512 \
  __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")))
#endif
#define ORTUNG_INLINE inline __attribute__((always_inline))
#elif defined(__aarch64__) && defined(__GNUC__)
#define ORTUNG_NEON 1
#define ORTUNG_INLINE inline __attribute__((always_inline))
#else
#define ORTUNG_INLINE inline
#endif

#pragma once

#include "ortung/base/InstructionSet.hpp"

/// Runs a loop as it was compiled for the widest instruction set that may be used.
namespace ortung {
namespace widest {

template <class Loop, class... Arguments>
void portable(Arguments... arguments) {
  Loop::run(arguments...);
}
#ifdef ORTUNG_X86
template <class Loop, class... Arguments>
ORTUNG_AVX2 void avx2(Arguments... arguments) {
  Loop::run(arguments...);
}
template <class Loop, class... Arguments>
ORTUNG_AVX512 void avx512(Arguments... arguments) {
  Loop::run(arguments...);
}
#endif

}  // namespace widest

/// Calls Loop::run(arguments...), a static ORTUNG_INLINE function that gives the same bits however
/// wide it is (InstructionSet.hpp). Arguments are copied: pointers, numbers.
template <class Loop, class... Arguments>
void runWidest(Arguments... arguments) {
#ifdef ORTUNG_X86
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return widest::avx512<Loop>(arguments...);
    case InstructionSet::kAvx2:
      return widest::avx2<Loop>(arguments...);
    case InstructionSet::kPortable:
    case InstructionSet::kNeon:
      break;
  }
#endif
  widest::portable<Loop>(arguments...);
}

}  // namespace ortung

// hot_calls: makes each hot call once where callgrind counts, under the call's name.
#include <valgrind/callgrind.h>

#include <cstdio>

#include "HotCall.hpp"
#include "ortung/base/InstructionSet.hpp"

int main() {
  using namespace ortung::instructions;
  if (!ortung::hasInstructionSet(ortung::InstructionSet::kAvx2)) {
    std::fprintf(stderr, "this machine has no AVX2\n");
    return 77;
  }
  HotCalls calls;
  addWeighing(calls);
  addFiltering(calls);
  addSimulation(calls);
  addTalk(calls);
  for (const HotCall& call : calls) {
    call.make();  // buffers grow, and lazily made tables are there
    CALLGRIND_START_INSTRUMENTATION;
    call.make();
    CALLGRIND_STOP_INSTRUMENTATION;
    CALLGRIND_DUMP_STATS_AT(call.name.c_str());
  }
  return 0;
}

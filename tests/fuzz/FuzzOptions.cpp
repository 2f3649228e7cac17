// What all targets have in common.

/// Looking for uses of a function's variables after its return costs a sweep at each exception:
/// half of the time of targets whose inputs are mostly refused. All tests look for them under the
/// address sanitizer (preset asan); ASAN_OPTIONS=detect_stack_use_after_return=1 does so here, too.
extern "C" const char* __asan_default_options() {
  return "detect_stack_use_after_return=0:malloc_context_size=12";
}

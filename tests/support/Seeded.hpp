#pragma once

#include <stdlib.h>

namespace ortung::test {

/// Include into files with property tests: the same cases in every run, unless $RC_PARAMS says
/// otherwise.
inline const bool kSeeded = ::setenv("RC_PARAMS", "seed=20", 0) == 0;

}  // namespace ortung::test

#pragma once

/// Declares a constant of the filter, in the ...Tuning.hpp header of its folder (see
/// mcl/README.md).
///
/// A build with ORTUNG_SWEEP takes other values from the environment (ORTUNG_CONSTANTS, see
/// scripts/sweep.py), so that the effect of each constant can be measured; in all other builds it
/// is an ordinary constexpr number.
#ifdef ORTUNG_SWEEP
#include "Swept.hpp"
#define ORTUNG_CONSTANT(part, name, value) \
  inline const auto name = ::ortung::swept(#part "." #name, value)
#else
#define ORTUNG_CONSTANT(part, name, value) inline constexpr auto name = value
#endif

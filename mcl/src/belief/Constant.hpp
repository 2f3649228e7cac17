#pragma once

/// Declares a constant of the filter, in the header of its room (see mcl/README.md).
///
/// A build with ORTUNG_SWEEP takes other values from the environment (ORTUNG_CONSTANTS, see
/// scripts/sweep.py), so that what each one changes can be measured; in all others it is a number
/// like any other.
#ifdef ORTUNG_SWEEP
#include "Swept.hpp"
#define ORTUNG_CONSTANT(part, name, value) \
  inline const auto name = ::ortung::swept(#part "." #name, value)
#else
#define ORTUNG_CONSTANT(part, name, value) inline constexpr auto name = value
#endif

#pragma once

#include <string>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// One reason for or against a result: a figure beside what is needed.
struct Check {
  std::string name;       ///< what is checked
  double found = 0;       ///< the figure; not a number: it could not be computed, so it is not met
  double needed = 0;      ///< its bound, in the same unit
  bool isAtLeast = true;  ///< whether the bound is the least value; else it is the greatest
  std::string unit;       ///< "m", "px", "%", ...; empty: a number
  int digits = 0;         ///< decimals with which it is written
  std::string advice;     ///< what to do if it is not met: "take pictures that ..." without "take"

  /// Whether the figure is within its bound.
  bool isMet() const { return isAtLeast ? found >= needed : found <= needed; }
};

/// Whether a result can be relied on, and why.
struct ORTUNG_API Verdict {
  std::vector<Check> checks;  ///< all that were made, met or not

  /// Whether there were checks and all of them are met.
  bool isDetermined() const;
  /// "determined", or "not determined: take pictures that ...", with each advice once.
  std::string sentence() const;
};

}  // namespace ortung

#pragma once

#include <algorithm>

#include "ReadingsTuning.hpp"
#include "ortung/mcl/MclConfig.hpp"

namespace ortung {

/// How much of an update's time (MclConfig::budgetMs) is left for searches, by the nominal times of
/// the weighers. No clock is read, so replays do the same in each update.
class UpdateTime {
 public:
  /// @param config borrowed
  explicit UpdateTime(const MclConfig& config) : config_(config) {}

  void begin() { spent_ = 0.0; }
  void spend(double nominalNanoseconds) { spent_ += 1e-6 * nominalNanoseconds; }
  /// Returns the time left nominal time spent since begin() [ms]; it is always above zero, so that
  /// searches end.
  double left() const {
    return std::max(tuning::budget::kShare * config_.budgetMs - spent_,
                    tuning::budget::kLeastShare * config_.budgetMs);
  }

 private:
  const MclConfig& config_;
  double spent_ = 0.0;  ///< [ms]
};

}  // namespace ortung

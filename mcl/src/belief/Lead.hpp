#pragma once

#include "BeliefTuning.hpp"
#include "ortung/base/Export.hpp"

namespace ortung {

/// The evidence of readings for another place against the belief, summed over readings: ln p(s |
/// other place) - ln p(s | belief). It is a sequential probability ratio test (Wald 1945) on
/// bounded terms. No single reading decides, however certain its sensor model is, since errors
/// within one scan are correlated: each reading counts at most 4 nats, or more for a place that
/// hardly any other one can be confused with (mostNatsFor()). Readings from one place do not
/// decide, either: each is weighted by the distance travelled since the one before.
class ORTUNG_API Lead {
 public:
  /// @param most most that one reading counts [nats]
  explicit Lead(double most = tuning::lead::kMostNatsOfAReading) : most_(most) {}
  /// @param ratio log-likelihood ratio of one time step's readings [nats]
  /// @param part distance travelled as a share of that after which readings are independent; above
  ///   1 it counts as 1
  void count(double ratio, double part);
  double nats() const { return nats_; }
  void atLeast(double nats);
  /// Adds what counted for the same place before, if it counted in its favour.
  void add(const Lead& before);
  void forget() { nats_ = 0.0; }
  bool isEnough() const;  ///< several readings support it, since each counts only so much
  bool isHopeless() const;

 private:
  double most_;
  double nats_ = 0.0;
};

/// Returns the most that a reading counts for a place which is one of @p places that explain a
/// reading about as well [nats]. A wrong place explains one as well as the true one does only if it
/// looks like it, and the fewer there are, the less probable it is that this is one of them.
/// @param places at least 1
ORTUNG_API double mostNatsFor(int places);

}  // namespace ortung

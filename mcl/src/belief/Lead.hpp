#pragma once

#include "ortung/base/Export.hpp"

namespace ortung {

/// The evidence of readings for another place against the belief, summed over readings: ln p(s |
/// other place) - ln p(s | belief). It is a sequential probability ratio test (Wald 1945) on
/// bounded terms. No single reading decides, however certain its sensor model is, since errors
/// within one scan are correlated: each reading counts at most 4 nats. Readings from one place do
/// not decide, either: each is weighted by the distance travelled since the one before.
class ORTUNG_API Lead {
 public:
  /// @param ratio log-likelihood ratio of one time step's readings [nats]
  /// @param part distance travelled as a share of that after which readings are independent; above
  ///   1 it counts as 1
  void count(double ratio, double part);
  double nats() const { return nats_; }
  void atLeast(double nats);
  bool isEnough() const;  ///< at least four readings support it
  bool isHopeless() const;

 private:
  double nats_ = 0.0;
};

}  // namespace ortung

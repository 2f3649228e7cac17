#pragma once

#include "ortung/base/Export.hpp"

namespace ortung {

/// What readings say for another place than the belief's: the sum of ln p(s | there) - ln p(s |
/// belief). No single reading decides, however sure its model is: errors of one scan are of one
/// piece, so each counts 4 nats at most. Nor do readings from one place: they count by the way
/// between them. A sequential probability ratio test (Wald 1945) on such bounded terms.
class ORTUNG_API Lead {
 public:
  /// @param ratio [nats]
  /// @param part of the way at which readings are independent, in [0, 1] and more
  void count(double ratio, double part);
  double nats() const { return nats_; }
  void atLeast(double nats);
  bool isEnough() const;  ///< four readings at least that all speak for it
  bool isHopeless() const;

 private:
  double nats_ = 0.0;
};

}  // namespace ortung

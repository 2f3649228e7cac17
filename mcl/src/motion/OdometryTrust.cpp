#include "OdometryTrust.hpp"

#include "MotionTuning.hpp"

namespace ortung {

void OdometryTrust::lose() {
  lost_ = true;
  lead_ = {};
}

void OdometryTrust::compare(double ratio, double way) {
  lead_.count(ratio, way / tuning::trust::kIndependent);
  lead_.atLeast(-tuning::trust::kRegained);
  if (lead_.nats() >= tuning::trust::kRegained) lost_ = false;
}

}  // namespace ortung

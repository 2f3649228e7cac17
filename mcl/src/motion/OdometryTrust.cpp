#include "OdometryTrust.hpp"

#include "BeliefTuning.hpp"
#include "MotionTuning.hpp"

namespace ortung {

void OdometryTrust::lose() {
  lost_ = true;
  lead_.forget();
}

void OdometryTrust::compare(double ratio, double travelled) {
  lead_.count(ratio, travelled / tuning::trust::kIndependent);
  lead_.atLeast(-tuning::lead::kEnoughForRule);
  if (lead_.nats() >= tuning::lead::kEnoughForRule) lost_ = false;
}

}  // namespace ortung

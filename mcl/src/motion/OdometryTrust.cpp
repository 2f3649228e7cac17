#include "OdometryTrust.hpp"

namespace ortung {
namespace {

constexpr double kIndependent = 0.1;  ///< way after which a reading counts whole [m]
constexpr double kWorst = -8.0;       ///< [nats]: what is long past does not count against it
constexpr double kRegained = 8.0;     ///< [nats]

}  // namespace

void OdometryTrust::lose() {
  lost_ = true;
  lead_ = {};
}

void OdometryTrust::compare(double ratio, double way) {
  lead_.count(ratio, way / kIndependent);
  lead_.atLeast(kWorst);
  if (lead_.nats() >= kRegained) lost_ = false;
}

}  // namespace ortung

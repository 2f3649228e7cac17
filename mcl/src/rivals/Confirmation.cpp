#include "Confirmation.hpp"

#include "RivalsTuning.hpp"

namespace ortung {

void Confirmation::count(bool isUsual, double way) {
  if (!isUsual) return;
  way_ += way;
  ++readings_;
  if (way_ >= tuning::hypothesis::kDistance && readings_ >= tuning::confirmation::kReadings)
    isOpen_ = false;
}

}  // namespace ortung

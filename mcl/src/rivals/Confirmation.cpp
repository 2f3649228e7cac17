#include "Confirmation.hpp"

#include "RivalsTuning.hpp"

namespace ortung {

void Confirmation::count(bool isUsual, double travelled) {
  if (!isUsual) return;
  travelled_ += travelled;
  ++readings_;
  if (travelled_ >= tuning::hypothesis::kDistance && readings_ >= tuning::confirmation::kReadings)
    isOpen_ = false;
}

}  // namespace ortung

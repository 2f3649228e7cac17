#include "Confirmation.hpp"

namespace ortung {
namespace {

constexpr double kWay = 1.0;  ///< [m]: as rivals elsewhere need
constexpr int kReadings = 3;  ///< least number of readings that confirm a place

}  // namespace

void Confirmation::count(bool isUsual, double way) {
  if (!isUsual) return;
  way_ += way;
  ++readings_;
  if (way_ >= kWay && readings_ >= kReadings) isOpen_ = false;
}

}  // namespace ortung

#include "NominalTime.hpp"

#include "ortung/core/BlurrableWeigher.hpp"

namespace ortung {
namespace {

constexpr double kOtherNanoseconds = 50.0;  ///< that weighers take for a pose if they don't say

}  // namespace

double nominalNanoseconds(const Weigher& reading) {
  const auto* blurrable = dynamic_cast<const BlurrableWeigher*>(&reading);
  return blurrable ? blurrable->nominalNanoseconds() : kOtherNanoseconds;
}

}  // namespace ortung

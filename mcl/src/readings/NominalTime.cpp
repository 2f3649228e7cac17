#include "NominalTime.hpp"

#include "ortung/core/BlurrableWeigher.hpp"

namespace ortung {
namespace {

constexpr double kOtherNanoseconds =
    50.0;  ///< time per pose of weighers that don't report their own [ns]

}  // namespace

double nominalNanoseconds(const Weigher& reading) {
  const auto* blurrable = dynamic_cast<const BlurrableWeigher*>(&reading);
  return blurrable ? blurrable->nominalNanoseconds() : kOtherNanoseconds;
}

}  // namespace ortung

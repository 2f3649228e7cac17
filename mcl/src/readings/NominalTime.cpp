#include "NominalTime.hpp"

#include "ortung/core/BlurrableWeigher.hpp"

namespace ortung {
namespace {

/// Time per pose of weighers that don't report their own [ns].
constexpr double kOtherNanoseconds = 50.0;

}  // namespace

double nominalNanoseconds(const Weigher& reading) {
  const auto* blurrable = dynamic_cast<const BlurrableWeigher*>(&reading);
  return blurrable ? blurrable->nominalNanoseconds() : kOtherNanoseconds;
}

}  // namespace ortung

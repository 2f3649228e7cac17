#include "NominalTime.hpp"

#include "ReadingsTuning.hpp"
#include "ortung/core/BlurrableWeigher.hpp"

namespace ortung {

double nominalNanoseconds(const Weigher& reading) {
  const auto* blurrable = dynamic_cast<const BlurrableWeigher*>(&reading);
  return blurrable ? blurrable->nominalNanoseconds() : tuning::nominal::kOtherNanoseconds;
}

}  // namespace ortung

#include "ScanExpectations.hpp"

#include <algorithm>
#include <cmath>

#include "FormatTools.hpp"

namespace ortung {

std::unique_ptr<Expectations> expectationsOf(const ScanData& scan, const ScanData::Config& config) {
  return config.perception == ScanData::Perception::kRays ? expectedRays(scan, config)
                                                          : expectedEndPoints(scan, config);
}

std::string scanKey(const ScanData& scan, const std::string& perception) {
  const ScanData::Config& config = scan.config();
  return "scan beams=" + std::to_string(config.beams) +
         " first_rad=" + keyNumber(config.firstAngle) + " step_rad=" + keyNumber(config.angleStep) +
         " max_range_m=" + keyNumber(config.maxRange) + " perception=" + perception + " " +
         mountKey(scan.mount());
}

int fewestViews(const ScanData::Config& config) {
  const double span = std::min(config.beams * config.angleStep, kTurn);
  const auto views = static_cast<int>(std::ceil(kTurn / span - 1e-9));
  // With one view more than a turn needs, beams of the views interleave, so fewer directions stay
  // empty.
  return views == 1 ? 1 : views + 1;
}

}  // namespace ortung

#include "MrptScan.hpp"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>

#include "BenchField.hpp"

namespace ortung::bench {

struct MrptScan::Impl {
  mrpt::maps::COccupancyGridMap2D map;
  mrpt::obs::CObservation2DRangeScan::Ptr scan = mrpt::obs::CObservation2DRangeScan::Create();
};

MrptScan::MrptScan() : impl_(std::make_unique<Impl>()) {
  mrpt::maps::COccupancyGridMap2D& map = impl_->map;
  const double margin = 0.5;  // for the walls
  map.setSize(-kLength / 2 - margin, kLength / 2 + margin, -kWidth / 2 - margin,
              kWidth / 2 + margin, static_cast<float>(kCell));
  for (unsigned row = 0; row < map.getSizeY(); ++row) {
    for (unsigned column = 0; column < map.getSizeX(); ++column) {
      const bool solid = isInsideSolid(static_cast<double>(map.idx2x(static_cast<int>(column))),
                                       static_cast<double>(map.idx2y(static_cast<int>(row))));
      map.setCell(static_cast<int>(column), static_cast<int>(row), solid ? 0.0F : 1.0F);
    }
  }
  map.likelihoodOptions.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
  map.likelihoodOptions.LF_decimation = 1;  // all beams, as the others
  const std::vector<float> ranges = scanAt(kRobot);
  mrpt::obs::CObservation2DRangeScan& scan = *impl_->scan;
  scan.aperture = static_cast<float>((kBeams - 1) * kRadiansADegree);
  scan.maxRange = static_cast<float>(kMaxRange);
  scan.sensorPose = mrpt::poses::CPose3D(0, 0, 0, -0.5 * kRadiansADegree, 0, 0);
  scan.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan.setScanRange(i, std::isfinite(ranges[i]) ? ranges[i] : 0.0F);
    scan.setScanRangeValidity(i, std::isfinite(ranges[i]));
  }
}

MrptScan::~MrptScan() = default;

void MrptScan::getProbability(const SampleView& samples, std::span<float> logProbability) const {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const mrpt::poses::CPose2D pose(static_cast<double>(samples.x[i]),
                                    static_cast<double>(samples.y[i]),
                                    static_cast<double>(samples.theta[i]));
    logProbability[i] += static_cast<float>(
        impl_->map.computeObservationLikelihood(*impl_->scan, mrpt::poses::CPose3D(pose)));
  }
}

}  // namespace ortung::bench

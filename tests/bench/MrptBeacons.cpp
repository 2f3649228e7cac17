#include "MrptBeacons.hpp"

#include <mrpt/maps/CBeaconMap.h>
#include <mrpt/obs/CObservationBeaconRanges.h>

#include <cmath>

#include "BenchField.hpp"

namespace ortung::bench {

struct MrptBeacons::Impl {
  mrpt::maps::CBeaconMap map;
  mrpt::obs::CObservationBeaconRanges ranges;
};

MrptBeacons::MrptBeacons(std::span<const std::pair<double, double>> places, double sigma)
    : impl_(std::make_unique<Impl>()) {
  impl_->map.likelihoodOptions.rangeStd = sigma;
  impl_->ranges.stdError = static_cast<float>(sigma);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [x, y] = places[i];
    mrpt::maps::CBeacon beacon;
    beacon.m_ID = static_cast<std::int64_t>(i);
    beacon.m_typePDF = mrpt::maps::CBeacon::pdfGauss;
    beacon.m_locationGauss.mean = mrpt::poses::CPoint3D(x, y, 0.0);
    beacon.m_locationGauss.cov.setZero();
    impl_->map.push_back(beacon);
    mrpt::obs::CObservationBeaconRanges::TMeasurement reading;
    reading.sensedDistance = static_cast<float>(std::hypot(x - kRobot.x, y - kRobot.y));
    reading.beaconID = static_cast<std::int32_t>(i);
    impl_->ranges.sensedData.push_back(reading);
  }
}

MrptBeacons::~MrptBeacons() = default;

void MrptBeacons::getProbability(const SampleView& samples, std::span<float> logProbability) const {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const mrpt::poses::CPose2D pose(static_cast<double>(samples.x[i]),
                                    static_cast<double>(samples.y[i]),
                                    static_cast<double>(samples.theta[i]));
    logProbability[i] += static_cast<float>(
        impl_->map.computeObservationLikelihood(impl_->ranges, mrpt::poses::CPose3D(pose)));
  }
}

}  // namespace ortung::bench

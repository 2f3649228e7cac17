#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "LandmarkPlaces.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/BlurrableWeigher.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Weighs samples by sightings of which nobody knows which landmarks they are of. For each sighting
///   p = (1 - outliers) exp(-(range error / sigma)^2 / 2 - (bearing error / sigma)^2 / 2) +
///   outliers
/// of the landmark that is nearest to where the sighting lies, seen from the sample. That is the
/// mixture over all landmarks (Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.6, with
/// unknown correspondence), of which all parts but the largest are left out: landmarks that are
/// told apart at all are many sigmas apart. Which one is nearest comes from a grid, so the cost
/// does not grow with the number of landmarks.
class UnidentifiedSight final : public BlurrableWeigher, public Polishable {
 public:
  /// What stays: the noise of ranges and bearings, and ln p by sigmas. Outliers and exponent are
  /// those of the range.
  struct Model {
    Model(const SensorModel& range, const SensorModel& bearing);
    SensorModel range;
    SensorModel bearing;
    GaussianTable logByError;
  };

  /// @param mount of the sensor that sees them
  UnidentifiedSight(std::shared_ptr<const Model> model,
                    std::shared_ptr<const LandmarkPlaces> places, const Pose2& mount);
  void add(double range, double bearing);
  bool isEmpty() const { return ranges_.empty(); }

  std::shared_ptr<const BlurrableWeigher> blurred(const PoseResolution& spread) const override;
  double nominalNanoseconds() const override;
  Slope slopeAt(const Pose2& robot) const override;

 private:
  double logProbabilityAt(const Pose2& pose) const override;
  /// The floor for each sighting where the sensor is outside of the region.
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;

  std::shared_ptr<const Model> model_;
  std::shared_ptr<const LandmarkPlaces> places_;
  Pose2 mount_;
  std::vector<double> ranges_;    ///< [m]
  std::vector<double> bearings_;  ///< bearings in the sensor's frame [rad]
  // Of each, in the sensor's frame:
  std::vector<float> aheadX_;  ///< its direction
  std::vector<float> aheadY_;
  std::vector<float> metres_;     ///< its range [m]
  std::vector<float> perAlong_;   ///< weight 1 / sigma along the direction [1/m]
  std::vector<float> perAcross_;  ///< weight 1 / sigma across the direction [1/m]
};

}  // namespace ortung

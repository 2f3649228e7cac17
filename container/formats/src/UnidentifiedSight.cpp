#include "UnidentifiedSight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "CellLookup.hpp"
#include "TableSlope.hpp"
#include "ortung/base/FastMath.hpp"

namespace ortung {
namespace {

constexpr double kNearest = 0.01;  ///< what is seen at the sensor itself has no bearing [m]

}  // namespace

UnidentifiedSight::Model::Model(const SensorModel& ofRange, const SensorModel& ofBearing)
    : range(ofRange), bearing(ofBearing), logByError(ofRange) {}

UnidentifiedSight::UnidentifiedSight(std::shared_ptr<const Model> model,
                                     std::shared_ptr<const LandmarkPlaces> places,
                                     const Pose2& mount)
    : model_(std::move(model)), places_(std::move(places)), mount_(mount) {}

void UnidentifiedSight::add(double range, double bearing) {
  ranges_.push_back(range);
  bearings_.push_back(bearing);
  aheadX_.push_back(static_cast<float>(std::cos(bearing)));
  aheadY_.push_back(static_cast<float>(std::sin(bearing)));
  metres_.push_back(static_cast<float>(range));
  perAlong_.push_back(static_cast<float>(1.0 / model_->range.sigmaAt(range)));
  perAcross_.push_back(
      static_cast<float>(1.0 / (model_->bearing.sigma * std::max(kNearest, range))));
}

std::shared_ptr<const BlurrableWeigher> UnidentifiedSight::blurred(
    const PoseResolution& spread) const {
  auto other = std::make_shared<UnidentifiedSight>(model_, places_, mount_);
  for (std::size_t k = 0; k < ranges_.size(); ++k) {
    other->add(ranges_[k], bearings_[k]);
    const auto wider = [&](float per, double by) {
      return static_cast<float>(1.0 / std::hypot(1.0 / static_cast<double>(per), by));
    };
    const double turn = spread.radians * ranges_[k];
    other->perAlong_[k] = wider(perAlong_[k], spread.metres);
    other->perAcross_[k] = wider(perAcross_[k], std::hypot(spread.metres, turn));
  }
  return other;
}

double UnidentifiedSight::nominalNanoseconds() const {
  return 20.0 + 4.0 * static_cast<double>(ranges_.size());
}

double UnidentifiedSight::logProbabilityAt(const Pose2& pose) const {
  const Pose2 sensor = pose * mount_;
  const bool isInside = places_->region().cellAt(sensor.x, sensor.y) >= 0;
  return isInside ? Weigher::logProbabilityAt(pose) : std::numeric_limits<double>::quiet_NaN();
}

void UnidentifiedSight::weigh(const SampleView& poses, std::span<float> logProbability) const {
  const CellLookup inRegion(places_->region());
  const CellLookup lookup(places_->grid());
  const std::uint16_t* nearest = places_->nearest().data();
  const GaussianTable& logs = model_->logByError;
  const float floor = logs.atPlace(GaussianTable::kFloorPlace);
  const std::size_t count = metres_.size();
  forEachSensorPose(poses, mount_, [&](std::size_t i, float x, float y, float theta) {
    if (inRegion.index(x, y) < 0) {
      logProbability[i] += floor * static_cast<float>(count);
      return;
    }
    const auto [sine, cosine] = sinCos(theta);
    float sum = 0.0F;
    for (std::size_t k = 0; k < count; ++k) {
      const float ux = cosine * aheadX_[k] - sine * aheadY_[k];
      const float uy = sine * aheadX_[k] + cosine * aheadY_[k];
      const float ex = x + metres_[k] * ux;
      const float ey = y + metres_[k] * uy;
      const std::int32_t cell = lookup.index(ex, ey);
      const std::uint16_t which = cell < 0 ? LandmarkPlaces::kNone : nearest[cell];
      if (which == LandmarkPlaces::kNone) {
        sum += floor;
        continue;
      }
      const float dx = static_cast<float>(places_->x(which)) - ex;
      const float dy = static_cast<float>(places_->y(which)) - ey;
      const float along = (dx * ux + dy * uy) * perAlong_[k];
      const float across = (dy * ux - dx * uy) * perAcross_[k];
      sum += logs(std::sqrt(along * along + across * across));
    }
    logProbability[i] += sum;
  });
}

Slope UnidentifiedSight::slopeAt(const Pose2& robot) const {
  const Pose2 sensor = robot * mount_;
  Slope slope;
  for (std::size_t k = 0; k < ranges_.size(); ++k) {
    const double direction = sensor.theta + bearings_[k];
    const std::uint16_t which = places_->nearestTo(sensor.x + ranges_[k] * std::cos(direction),
                                                   sensor.y + ranges_[k] * std::sin(direction));
    if (which == LandmarkPlaces::kNone) continue;
    const double dx = places_->x(which) - sensor.x;
    const double dy = places_->y(which) - sensor.y;
    const double range = std::max(kNearest, std::hypot(dx, dy));
    const double tooLong = ranges_[k] - range;
    const double tooLarge = wrapAngle(direction - std::atan2(dy, dx));
    const double sigma = model_->range.sigmaAt(ranges_[k]);
    const double bearingSigma = model_->bearing.sigma;
    const double share =
        model_->range.exponent *
        inlierShare(model_->range.outliers, std::hypot(tooLong / sigma, tooLarge / bearingSigma));
    const double squared = range * range;
    slope.add(tooLong, byRobot(-dx / range, -dy / range, 0.0, robot, sensor),
              share / (sigma * sigma));
    slope.add(tooLarge, byRobot(dy / squared, -dx / squared, -1.0, robot, sensor),
              share / (bearingSigma * bearingSigma));
  }
  return slope;
}

}  // namespace ortung

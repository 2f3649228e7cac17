#include <cmath>
#include <optional>
#include <stdexcept>

#include "Disturbance.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

/// Returns what odometry reports for one piece of motion instead of the truth. A robot on wheels
/// drives an arc, whose chord points midway between its headings, so an altered turn bends it, too.
Pose2 altered(const Fault& fault, const Pose2& step) {
  switch (fault.kind) {
    case Fault::Kind::kScale:
      return {fault.values.at(0) * step.x, fault.values.at(0) * step.y, step.theta};
    case Fault::Kind::kReverse:
      return {-step.x, -step.y, step.theta};
    case Fault::Kind::kSlip:
      return {};
    case Fault::Kind::kTurns: {
      const double turn = fault.values.at(0) * step.theta;
      const double bend = (turn - step.theta) / 2;
      return Pose2{0, 0, bend} * Pose2{step.x, step.y, wrapAngle(turn - bend)};
    }
    default:
      return step;
  }
}

/// Adds up the altered pieces of motion, so that odometry never jumps unless it should.
class Altered : public Disturbance {
 public:
  explicit Altered(const Fault& fault) : fault_(fault) {}

  bool alter(Message& message, double, bool isNow) override {
    OdometryData data(message.id);
    try {
      data.setData(message.stamp, message.words);
    } catch (const std::invalid_argument&) {
      return true;  // the consumer reports what is wrong
    }
    OdometryData::Reading reading = data.reading();
    const Pose2 told = reading.pose;
    Pose2 step = last_ ? inverse(*last_) * told : Pose2{};
    if (!last_) sum_ = told;
    last_ = told;
    if (isNow) {
      step = change(step);
      changeVelocities(reading);
    }
    sum_ = begun_ ? sum_ * step : told;
    if (!begun_) return true;
    reading.pose = sum_;
    message.words = OdometryData::encode(reading);
    return true;
  }

 private:
  Pose2 change(const Pose2& step) {
    const bool isFirst = !begun_;
    begun_ = true;
    if (fault_.kind != Fault::Kind::kJump) return altered(fault_, step);
    const std::vector<double>& jump = fault_.values;
    return isFirst ? step * Pose2{jump.at(0), jump.at(1), jump.at(2)} : step;
  }

  void changeVelocities(OdometryData::Reading& reading) const {
    double way = 1.0;
    double turn = 1.0;
    if (fault_.kind == Fault::Kind::kScale) way = fault_.values.at(0);
    if (fault_.kind == Fault::Kind::kTurns) turn = fault_.values.at(0);
    if (fault_.kind == Fault::Kind::kReverse) way = -1.0;
    if (fault_.kind == Fault::Kind::kSlip) way = turn = 0.0;
    reading.translationalVelocity *= way;
    reading.lateralVelocity *= way;
    reading.rotationalVelocity *= turn;
  }

  Fault fault_;
  std::optional<Pose2> last_;  ///< last pose that the robot reported
  Pose2 sum_;                  ///< pose that is reported instead
  bool begun_ = false;
};

}  // namespace

std::unique_ptr<Disturbance> makeOdometryFault(const Fault& fault) {
  return std::make_unique<Altered>(fault);
}

}  // namespace ortung

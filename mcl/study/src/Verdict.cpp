#include "ortung/study/Verdict.hpp"

#include <optional>

namespace ortung {
namespace {

constexpr double kPieceOfPath = 0.05;  ///< step of the distance travelled [m]

}  // namespace

double DistanceMeter::add(const Pose2& pose) {
  if (!isBegun_) anchor_ = pose;
  isBegun_ = true;
  const double piece = distance(anchor_, pose);
  if (piece < kPieceOfPath) return travelled_;
  anchor_ = pose;
  return travelled_ += piece;
}

Verdict judge(std::span<const EvaluationPoint> points, Timestamp since, Timestamp until,
              const RightRule& rule) {
  DistanceMeter meter;
  std::optional<Verdict> candidate;
  for (const EvaluationPoint& p : points) {
    if (p.stamp < since) continue;
    if (p.stamp >= until) break;
    const double travelled = meter.add(p.truth);
    if (!(p.positionError < rule.metres && p.headingError < rule.radians)) {
      candidate.reset();
    } else if (!candidate) {
      candidate = {Verdict::State::kRight, p.stamp, toSeconds(p.stamp - since), travelled};
    }
    if ((candidate ? candidate->travelled : travelled) > rule.mostTravelled)
      return {.state = Verdict::State::kWrong};
    if (candidate && toSeconds(p.stamp - candidate->stamp) >= rule.seconds) return *candidate;
  }
  return {};
}

}  // namespace ortung

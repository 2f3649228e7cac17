#include "ortung/study/Verdict.hpp"

#include <optional>

namespace ortung {
namespace {

constexpr double kPieceOfWay = 0.05;  ///< step of the distance travelled [m]

}  // namespace

double WayMeter::add(const Pose2& pose) {
  if (!isBegun_) anchor_ = pose;
  isBegun_ = true;
  const double piece = distance(anchor_, pose);
  if (piece < kPieceOfWay) return way_;
  anchor_ = pose;
  return way_ += piece;
}

Verdict judge(std::span<const EvaluationPoint> points, Timestamp since, Timestamp until,
              const RightRule& rule) {
  WayMeter meter;
  std::optional<Verdict> candidate;
  for (const EvaluationPoint& p : points) {
    if (p.stamp < since) continue;
    if (p.stamp >= until) break;
    const double way = meter.add(p.truth);
    if (!(p.positionError < rule.metres && p.headingError < rule.radians)) {
      candidate.reset();
    } else if (!candidate) {
      candidate = {Verdict::State::kRight, p.stamp, toSeconds(p.stamp - since), way};
    }
    if ((candidate ? candidate->way : way) > rule.mostWay) return {.state = Verdict::State::kWrong};
    if (candidate && toSeconds(p.stamp - candidate->stamp) >= rule.seconds) return *candidate;
  }
  return {};
}

}  // namespace ortung

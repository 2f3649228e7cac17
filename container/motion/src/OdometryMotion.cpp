#include "ortung/motion/OdometryMotion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "MotionFit.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/FastMath.hpp"
#include "ortung/base/GaussianRows.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBlock = 256;         ///< samples whose noise is drawn at once
constexpr std::size_t kNumbersASample = 4;  ///< first turn, distance, second turn, sideways
constexpr double kMostSlip = 0.2;           ///< greatest share of slip that is learned
constexpr double kSmallestSigma = 0.005;    ///< least sigma that is learned
constexpr double kMostWayBias = 0.5;        ///< greatest bias, as a share of the distance travelled
constexpr double kShortestWay = 1e-3;       ///< least distance that has a direction of its own [m]

double square(double value) { return value * value; }

/// A change of pose as turn, distance, turn; driving backwards is a negative distance.
struct Turns {
  double first;
  double way;
  double second;
};

Turns decompose(const Pose2& change) {
  const double way = std::hypot(change.x, change.y);
  if (way < kShortestWay) return {0.0, way, change.theta};
  const double direction = std::atan2(change.y, change.x);
  if (std::abs(direction) <= std::numbers::pi / 2)
    return {direction, way, wrapAngle(change.theta - direction)};
  const double backwards = wrapAngle(direction + std::numbers::pi);
  return {backwards, -way, wrapAngle(change.theta - backwards)};
}

/// Sigmas of a change's noise.
struct Sigmas {
  double first;
  double way;
  double second;
  double sideways;
};

Sigmas sigmasOf(const OdometryNoise& noise, const Turns& turns) {
  const double turning = std::abs(turns.first) + std::abs(turns.second);
  const double turnByWay =
      0.5 * square(noise.turnPerMetre) * std::abs(turns.way);  // each turn gets half
  return {std::sqrt(square(noise.turnPerTurn) * std::abs(turns.first) + turnByWay),
          std::sqrt(square(noise.wayPerMetre) * std::abs(turns.way) +
                    square(noise.wayPerTurn) * turning + square(noise.floorMetres)),
          std::sqrt(square(noise.turnPerTurn) * std::abs(turns.second) + turnByWay +
                    square(noise.floorRadians)),
          noise.floorMetres};
}

/// One step's motion and its noise, in single precision.
struct Step {
  float turn1;
  float way;
  float turn2;
  float sigmaTurn1;
  float sigmaWay;
  float sigmaTurn2;
  float sigmaSideways;
};

/// Numbers of mean 0 and sigma 1: a row for each kind of noise, a column for each sample.
using Noise = std::array<std::array<float, kBlock>, kNumbersASample>;

/// Moves @p n samples.
struct MoveAll {
  ORTUNG_INLINE static void run(const Step& step, const Noise* rows, std::size_t n,
                                float* __restrict x, float* __restrict y, float* __restrict theta) {
    const Noise& noise = *rows;
    for (std::size_t i = 0; i < n; ++i) {
      const float heading = theta[i] + step.turn1 + step.sigmaTurn1 * noise[0][i];
      const float way = step.way + step.sigmaWay * noise[1][i];
      const float sideways = step.sigmaSideways * noise[3][i];
      const SinCos direction = sinCos(heading);
      x[i] += way * direction.cos - sideways * direction.sin;
      y[i] += way * direction.sin + sideways * direction.cos;
      theta[i] = heading + step.turn2 + step.sigmaTurn2 * noise[2][i];
    }
  }
};

/// Reads the keys of [motion].
OdometryNoise readNoise(const Parameters& motion) {
  motion.textOr("plugin", "");
  OdometryCorrection::read(motion);
  return OdometryNoise::read(motion);
}

/// Adds the first and second moments of what moves from the origin: E x, E y, then the products.
/// A turn of variance v has E cos(a + turn) = exp(-v/2) cos a, and E turn cos(a + turn) = -v
/// exp(-v/2) sin a; way, sideways and the turns are independent of each other.
void addMoments(const Turns& turns, const Sigmas& sigmas, double factor, double share,
                MotionChange& sum) {
  const double v = square(factor * sigmas.first);
  const double shorter = std::exp(-0.5 * v);
  const double doubled = square(square(shorter));
  const double along = shorter * std::cos(turns.first);
  const double across = shorter * std::sin(turns.first);
  const double way2 = square(turns.way) + square(factor * sigmas.way);
  const double sideways2 = square(factor * sigmas.sideways);
  const double even = 0.5 * (way2 + sideways2);
  const double odd = 0.5 * doubled * (way2 - sideways2);
  const double cosine = odd * std::cos(2.0 * turns.first);
  sum.mean.x += share * turns.way * along;
  sum.mean.y += share * turns.way * across;
  sum.covariance[0] += share * (even + cosine);
  sum.covariance[1] += share * odd * std::sin(2.0 * turns.first);
  sum.covariance[2] -= share * turns.way * v * across;
  sum.covariance[4] += share * (even - cosine);
  sum.covariance[5] += share * turns.way * v * along;
  sum.covariance[8] += share * (v + square(factor * sigmas.second));
}

/// Returns the sigma of a learned variance, or @p old if nothing was learned. A drive that is too
/// short to show any noise does not prove that there is none.
double learnedSigma(double variance, double old) {
  return variance < 0.0 ? old : std::max(std::sqrt(variance), kSmallestSigma);
}

}  // namespace

/// Errors of odometry in all drives so far; the last drive may go on.
struct OdometryMotion::Learning {
  std::vector<std::vector<MotionError>> turns{1};
  std::vector<std::vector<MotionError>> ways{1};
};

void OdometryNoise::check() const {
  for (const double sigma :
       {turnPerTurn, turnPerMetre, wayPerMetre, wayPerTurn, floorMetres, floorRadians}) {
    if (!(sigma >= 0.0 && sigma <= 100.0))
      throw std::invalid_argument("odometry noise must be in [0, 100]");
  }
  if (!(slipShare >= 0.0 && slipShare <= 0.5))
    throw std::invalid_argument("odometry noise: the share that slips must be in [0, 0.5]");
}

std::uint64_t OdometryNoise::slipPeriod() const {
  constexpr double kLeast = 1e-9;  // fewer never happen
  return slipShare < kLeast ? 0 : static_cast<std::uint64_t>(std::lround(1.0 / slipShare));
}

double OdometryNoise::slips() const {
  const std::uint64_t period = slipPeriod();
  return period == 0 ? 0.0 : 1.0 / static_cast<double>(period);
}

OdometryNoise OdometryNoise::read(const Parameters& p) {
  OdometryNoise n;
  const Range range{0.0, 100.0};
  n.turnPerTurn = p.numberOr("turn_per_turn", n.turnPerTurn, range);
  n.turnPerMetre = p.numberOr("turn_per_m", n.turnPerMetre, range);
  n.wayPerMetre = p.numberOr("way_per_m", n.wayPerMetre, range);
  n.wayPerTurn = p.numberOr("way_per_turn", n.wayPerTurn, range);
  n.floorMetres = p.numberOr("floor_m", n.floorMetres, range);
  n.floorRadians = kDegree * p.numberOr("floor_deg", n.floorRadians / kDegree, range);
  n.slipShare = p.numberOr("slip_share", n.slipShare, {0.0, 0.5});
  p.refuseUnread();
  return n;
}

Pose2 OdometryCorrection::apply(const Pose2& change) const {
  const double turn = (turnScale - 1.0) * change.theta + turnBiasPerMetre * change.x;
  double scale = wayScale;
  if (wayBiasPerRadian != 0.0) {
    const double way = std::hypot(change.x, change.y);
    const double more = wayBiasPerRadian * std::abs(change.theta);
    if (way > 0.0) scale += std::clamp(more / way, -kMostWayBias, kMostWayBias);
  }
  if (turn == 0.0 && scale == 1.0) return change;
  // The motion's chord points along half of the turn.
  const double c = scale * std::cos(turn / 2.0);
  const double s = scale * std::sin(turn / 2.0);
  return {c * change.x - s * change.y, s * change.x + c * change.y, wrapAngle(change.theta + turn)};
}

OdometryCorrection OdometryCorrection::read(const Parameters& p) {
  OdometryCorrection c;
  c.wayScale = p.numberOr("way_scale", c.wayScale, {0.5, 2.0});
  c.turnScale = p.numberOr("turn_scale", c.turnScale, {0.5, 2.0});
  c.turnBiasPerMetre =
      kDegree * p.numberOr("turn_bias_deg_per_m", c.turnBiasPerMetre / kDegree, {-180.0, 180.0});
  c.wayBiasPerRadian = p.numberOr("way_bias_m_per_rad", c.wayBiasPerRadian, {-10.0, 10.0});
  c.delay = p.numberOr("delay_s", c.delay, {-0.3, 2.0});
  return c;
}

OdometryMotion::OdometryMotion(const OdometryNoise& noise, const OdometryCorrection& correction)
    : noise_(noise), correction_(correction) {
  noise_.check();
  setDelay(correction_.delay);
}

OdometryMotion::OdometryMotion(const Parameters& motion)
    : OdometryMotion(readNoise(motion), OdometryCorrection::read(motion)) {}

OdometryMotion::~OdometryMotion() = default;

void OdometryMotion::learnMotion(const Pose2& odometryChange, const Pose2& trueChange) {
  if (!isFinite(odometryChange) || !isFinite(trueChange)) return;
  if (!learning_) learning_ = std::make_unique<Learning>();
  const double turn = odometryChange.theta;
  const double way = std::hypot(odometryChange.x, odometryChange.y);
  // The direction is that of odometry's motion; if there is none, it is half of the turn.
  const double direction =
      way < kShortestWay ? turn / 2.0 : std::atan2(odometryChange.y, odometryChange.x);
  const double trueWay = trueChange.x * std::cos(direction) + trueChange.y * std::sin(direction);
  learning_->turns.back().push_back(
      {wrapAngle(trueChange.theta - turn), {turn, odometryChange.x}, {std::abs(turn), way}});
  learning_->ways.back().push_back(
      {trueWay - way, {way, way < kShortestWay ? 0.0 : std::abs(turn)}, {way, std::abs(turn)}});
}

void OdometryMotion::endDrive() {
  if (!learning_ || learning_->turns.back().empty()) return;
  learning_->turns.emplace_back();
  learning_->ways.emplace_back();
}

double OdometryMotion::endLearning() {
  const MotionFit turns = fitMotion(learning_ ? learning_->turns : Learning().turns);
  const MotionFit ways = fitMotion(learning_->ways);
  noise_.turnPerTurn = learnedSigma(turns.variance[0], noise_.turnPerTurn);
  noise_.turnPerMetre = learnedSigma(turns.variance[1], noise_.turnPerMetre);
  noise_.wayPerMetre = learnedSigma(ways.variance[0], noise_.wayPerMetre);
  noise_.wayPerTurn = learnedSigma(ways.variance[1], noise_.wayPerTurn);
  noise_.slipShare = std::min(std::max(turns.outliers, ways.outliers), kMostSlip);
  noise_.check();
  correction_.turnScale = std::clamp(1.0 + turns.scale[0], 0.5, 2.0);
  correction_.turnBiasPerMetre = std::clamp(turns.scale[1], -3.0, 3.0);
  correction_.wayScale = std::clamp(1.0 + ways.scale[0], 0.5, 2.0);
  correction_.wayBiasPerRadian = std::clamp(ways.scale[1], -10.0, 10.0);
  return turns.logLikelihood + ways.logLikelihood;
}

Parameters OdometryMotion::settings() const {
  Parameters p("learned motion");
  p.set("turn_per_turn", noise_.turnPerTurn);
  p.set("turn_per_m", noise_.turnPerMetre);
  p.set("way_per_m", noise_.wayPerMetre);
  p.set("way_per_turn", noise_.wayPerTurn);
  p.set("slip_share", noise_.slipShare);
  p.set("floor_m", noise_.floorMetres);
  p.set("floor_deg", noise_.floorRadians / kDegree);
  p.set("way_scale", correction_.wayScale);
  p.set("turn_scale", correction_.turnScale);
  p.set("turn_bias_deg_per_m", correction_.turnBiasPerMetre / kDegree);
  p.set("way_bias_m_per_rad", correction_.wayBiasPerRadian);
  p.set("delay_s", delay());
  return p;
}

MotionChange expectedChange(const OdometryNoise& noise, const OdometryCorrection& correction,
                            const Pose2& odometryChange) {
  const Turns turns = decompose(correction.apply(odometryChange));
  const Sigmas sigmas = sigmasOf(noise, turns);
  const double slips = noise.slips();
  MotionChange change;
  addMoments(turns, sigmas, 1.0, 1.0 - slips, change);
  if (slips > 0.0)
    addMoments(turns, sigmas, static_cast<double>(OdometryNoise::kSlip), slips, change);
  change.mean.theta = wrapAngle(turns.first + turns.second);
  PoseCovariance& c = change.covariance;
  c[0] = std::max(0.0, c[0] - square(change.mean.x));  // by rounding
  c[1] = c[3] = c[1] - change.mean.x * change.mean.y;
  c[4] = std::max(0.0, c[4] - square(change.mean.y));
  c[6] = c[2];
  c[7] = c[5];
  return change;
}

void OdometryMotion::sampleMotion(const MovableSamples& samples, const Pose2& odometryChange,
                                  std::uint64_t seed, std::uint64_t stream,
                                  std::uint64_t first) const {
  const Turns turns = decompose(correction_.apply(odometryChange));
  const Sigmas sigmas = sigmasOf(noise_, turns);
  const Step step{static_cast<float>(turns.first),    static_cast<float>(turns.way),
                  static_cast<float>(turns.second),   static_cast<float>(sigmas.first),
                  static_cast<float>(sigmas.way),     static_cast<float>(sigmas.second),
                  static_cast<float>(sigmas.sideways)};
  Noise noise;
  for (std::size_t begin = 0; begin < samples.x.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, samples.x.size() - begin);
    const auto row = [&](std::size_t k) { return std::span(noise[k]).first(count); };
    fillGaussianRows(seed, stream, first + begin, {row(0), row(1), row(2), row(3)});
    noise_.forEachSlip(first + begin, count, [&](std::size_t i) {
      for (std::array<float, kBlock>& numbers : noise) numbers[i] *= OdometryNoise::kSlip;
    });
    runWidest<MoveAll, Step, const Noise*>(step, &noise, count, samples.x.data() + begin,
                                           samples.y.data() + begin, samples.theta.data() + begin);
  }
}

}  // namespace ortung

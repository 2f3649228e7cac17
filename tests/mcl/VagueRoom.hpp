#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "FakeRoom.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/motion/OdometryMotion.hpp"

/// A room with two posts, seen so vaguely that the belief fills it, and that belief by quadrature.
namespace ortung::test {

inline constexpr double kSigmaRange = 0.25;
inline constexpr double kSigmaBearing = 0.15;
inline constexpr double kOutliers = 1e-4;
inline const Room kRoom{4, 3};
// On one wall, so that the distances to both leave one place in the room.
inline constexpr double kPosts[2][2] = {{-1.0, -1.5}, {1.2, -1.5}};
inline const OdometryNoise kNoise{.turnPerTurn = 0.0,
                                  .turnPerMetre = 0.3,
                                  .wayPerMetre = 0.25,
                                  .wayPerTurn = 0.0,
                                  .floorMetres = 0.05,
                                  .floorRadians = 0.05};

struct Reading {
  double range[2];
  double bearing;  ///< of the first post
};

/// Markov localization by eqs. 6 to 8 of the paper over all cells and headings: no samples, no
/// tables.
class Quadrature {
 public:
  static constexpr int kColumns = 80;
  static constexpr int kRows = 60;
  static constexpr int kTurns = 72;
  static constexpr double kCell = 0.05;
  static constexpr double kTurn = 2 * kPi / kTurns;

  Quadrature() : belief_(static_cast<std::size_t>(kColumns) * kRows * kTurns, 1.0) { normalize(); }

  void correct(const Reading& reading) {
    forEach([&](double& p, const Pose2& pose) {
      if (p == 0.0) return;
      for (int i = 0; i < 2; ++i) {
        const double range = std::hypot(kPosts[i][0] - pose.x, kPosts[i][1] - pose.y);
        p *= modelled(reading.range[i] - range, kSigmaRange, kOutliers);
      }
      p *= modelled(wrapAngle(reading.bearing - bearingTo(pose, kPosts[0][0], kPosts[0][1])),
                    kSigmaBearing, kOutliers);
    });
    normalize();
  }

  /// The integral of eq. 8, by Gauss-Hermite quadrature over the four noises.
  void predict(double way) {
    std::vector<double> moved(belief_.size(), 0.0);
    const double sigmaTurn = std::sqrt(0.5 * kNoise.turnPerMetre * kNoise.turnPerMetre * way);
    const double sigmaWay = std::hypot(kNoise.wayPerMetre * std::sqrt(way), kNoise.floorMetres);
    const double sigmaLast = std::hypot(sigmaTurn, kNoise.floorRadians);
    forEach([&](const double& p, const Pose2& pose) {
      if (p < 1e-8) return;  // of the whole belief, 345,600 cells
      for (const auto& [t1, w1] : kNodes) {
        const double heading = pose.theta + sigmaTurn * t1;
        for (const auto& [d, w2] : kNodes) {
          for (const auto& [s, w3] : kNodes) {
            const double along = way + sigmaWay * d;
            const double aside = kNoise.floorMetres * s;
            const double x = pose.x + along * std::cos(heading) - aside * std::sin(heading);
            const double y = pose.y + along * std::sin(heading) + aside * std::cos(heading);
            for (const auto& [t2, w4] : kNodes)
              spread(moved, {x, y, heading + sigmaLast * t2}, p * w1 * w2 * w3 * w4);
          }
        }
      }
    });
    belief_ = std::move(moved);
    normalize();
  }

  PoseEstimate moments() const {
    PoseEstimate e;
    double c = 0.0;
    double s = 0.0;
    forEach([&](const double& p, const Pose2& pose) {
      e.pose.x += p * pose.x;
      e.pose.y += p * pose.y;
      c += p * std::cos(pose.theta);
      s += p * std::sin(pose.theta);
    });
    e.pose.theta = std::atan2(s, c);
    forEach([&](const double& p, const Pose2& pose) {
      const double d[3] = {pose.x - e.pose.x, pose.y - e.pose.y,
                           wrapAngle(pose.theta - e.pose.theta)};
      for (std::size_t i = 0; i < 9; ++i) e.covariance[i] += p * d[i / 3] * d[i % 3];
    });
    return e;
  }

  /// Kullback-Leibler divergence of a sample set from this belief, both in bins of 0.25 m and 30
  /// degrees: sum of q ln(q / p).
  double divergenceOf(const SampleSet& samples) const {
    std::vector<double> p(kBins, 0.0);
    std::vector<double> q(kBins, 0.0);
    forEach([&](const double& share, const Pose2& pose) { p[binOf(pose)] += share; });
    double sum = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double weight = std::exp(static_cast<double>(samples.logWeight[i]));
      q[binOf({samples.x[i], samples.y[i], samples.theta[i]})] += weight;
      sum += weight;
    }
    double divergence = 0.0;
    for (std::size_t bin = 0; bin < kBins; ++bin)
      if (q[bin] > 0.0)
        divergence += q[bin] / sum * std::log(q[bin] / sum / std::max(p[bin], 1e-12));
    return divergence;
  }

 private:
  static constexpr std::size_t kBins = 16 * 12 * 12;
  static std::size_t binOf(const Pose2& pose) {
    const auto place = [](double at, double size, int count) {
      return static_cast<std::size_t>(
          std::clamp(static_cast<int>(std::floor(at / size)), 0, count - 1));
    };
    const double turn = pose.theta < 0.0 ? pose.theta + 2 * kPi : pose.theta;
    return (place(pose.y + 1.5, 0.25, 12) * 16 + place(pose.x + 2.0, 0.25, 16)) * 12 +
           place(turn, kPi / 6, 12);
  }
  // Nodes and weights for the normal distribution, exact for polynomials up to degree 5.
  static constexpr std::array<std::pair<double, double>, 3> kNodes = {
      {{-1.7320508075689, 1.0 / 6}, {0.0, 2.0 / 3}, {1.7320508075689, 1.0 / 6}}};

  template <class Visit>
  void forEach(const Visit& visit) const {
    const_cast<Quadrature*>(this)->forEach(
        [&](double& p, const Pose2& pose) { visit(std::as_const(p), pose); });
  }
  template <class Visit>
  void forEach(const Visit& visit) {
    std::size_t i = 0;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        for (int turn = 0; turn < kTurns; ++turn, ++i) {
          visit(belief_[i], {(column + 0.5) * kCell - 2.0, (row + 0.5) * kCell - 1.5,
                             wrapAngle((turn + 0.5) * kTurn)});
        }
      }
    }
  }

  /// Shares @p p between the two cells on either side along each axis, so that the mean stays.
  static void spread(std::vector<double>& to, const Pose2& pose, double p) {
    const double place[3] = {(pose.x + 2.0) / kCell - 0.5, (pose.y + 1.5) / kCell - 0.5,
                             pose.theta / kTurn - 0.5};
    for (int corner = 0; corner < 8; ++corner) {
      int cell[3];
      double share = p;
      for (int axis = 0; axis < 3; ++axis) {
        const double below = std::floor(place[axis]);
        const double part = place[axis] - below;
        const int up = (corner >> axis) & 1;
        cell[axis] = static_cast<int>(below) + up;
        share *= up ? part : 1 - part;
      }
      if (cell[0] < 0 || cell[0] >= kColumns || cell[1] < 0 || cell[1] >= kRows) continue;
      const int turn = (cell[2] % kTurns + kTurns) % kTurns;
      to[static_cast<std::size_t>((cell[1] * kColumns + cell[0]) * kTurns + turn)] += share;
    }
  }

  void normalize() {
    double sum = 0.0;
    for (const double p : belief_) sum += p;
    for (double& p : belief_) p /= sum;
  }

  std::vector<double> belief_;
};

/// The same world for filters: three features with tables, odometry.
struct VagueRobot {
  VagueRobot() {
    container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
    for (int i = 0; i < 2; ++i) {
      SensorData& range = container.add(std::make_unique<ScalarData>(
          id("Distance" + std::to_string(i)), Pose2{},
          ScalarData::Config{.model = {.sigma = kSigmaRange, .outliers = kOutliers}}));
      learnEverywhere(range, region, 0.1, [i](const Pose2& s) {
        return ScalarData::encode(std::hypot(kPosts[i][0] - s.x, kPosts[i][1] - s.y));
      });
    }
    SensorData& bearing = container.add(std::make_unique<BearingData>(
        id("Bearing"), Pose2{},
        BearingData::Config{.model = {.sigma = kSigmaBearing, .outliers = kOutliers}}));
    learnEverywhere(bearing, region, 0.1, [](const Pose2& s) {
      return BearingData::encode(bearingTo(s, kPosts[0][0], kPosts[0][1]));
    });
  }
  static SensorId id(const std::string& feature) { return {"cam", "camera", feature}; }
  static MclConfig config() {
    MclConfig config;
    config.minDistance = config.minRotation = 0.0;
    config.recoverSlow = 0.0;
    config.budgetMs = 1e6;  // of the start, too
    return config;
  }
  void read(double way, const Reading& reading) {
    odometry.x += way;
    stamp += 1000000;
    container.set(std::vector<Message>{
        {stamp, {"base", "odometry", "pose"}, OdometryData::encode({odometry, 0, 0, {}})},
        {stamp, id("Distance0"), ScalarData::encode(reading.range[0])},
        {stamp, id("Distance1"), ScalarData::encode(reading.range[1])},
        {stamp, id("Bearing"), BearingData::encode(reading.bearing)}});
  }
  const FieldRegion region = kRoom.region(0.025, 0.0);
  SensorContainer container;
  Pose2 odometry;
  Timestamp stamp = 0;
};

/// MCL on it.
struct McLocalizer {
  explicit McLocalizer(std::size_t samples = 60000, std::uint64_t seed = 1) {
    MclConfig config = VagueRobot::config();
    config.maxSamples = config.minSamples = samples;
    config.seed = seed;
    mcl = std::make_unique<Mcl>(config, robot.region, std::make_unique<OdometryMotion>(kNoise));
    mcl->startGlobal();
  }
  void step(double way, const Reading& reading) {
    robot.read(way, reading);
    ASSERT_TRUE(mcl->update(robot.container));
  }
  VagueRobot robot;
  std::unique_ptr<Mcl> mcl;
};

/// A drive straight on, and what is seen of it.
class VagueDrive {
 public:
  Reading after(double way) {
    truth_ = truth_ * Pose2{way, 0, 0};
    Reading reading{};
    for (int i = 0; i < 2; ++i)
      reading.range[i] = std::hypot(kPosts[i][0] - truth_.x, kPosts[i][1] - truth_.y) +
                         kSigmaRange * random_.gaussian();
    reading.bearing =
        bearingTo(truth_, kPosts[0][0], kPosts[0][1]) + kSigmaBearing * random_.gaussian();
    return reading;
  }

 private:
  Pose2 truth_{-0.6, 0.2, 0.4};
  Random random_{4};
};

}  // namespace ortung::test

// What devices get wrong always in the same way: learned from drives among points whose places are
// known exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "Biases.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr double kMetres = 0.05;  ///< noise of distances
constexpr double kRadians = 0.02;

struct Seen {
  double x;  ///< of the landmark
  double y;
  double distance;
  double bearing;
};

class Reading final : public Weigher, public Correctable {
 public:
  explicit Reading(std::vector<Seen> seen) : seen_(std::move(seen)) {}
  void residualsAt(const Pose2& pose, std::vector<ReadingResidual>& residuals) const override {
    for (const Seen& s : seen_) {
      const double dx = s.x - pose.x;
      const double dy = s.y - pose.y;
      const double r = std::hypot(dx, dy);
      const double b = wrapAngle(std::atan2(dy, dx) - pose.theta);
      residuals.push_back({false, s.distance - r, r, {-dx / r, -dy / r, 0.0}, kMetres, 0.01});
      residuals.push_back(
          {true, wrapAngle(s.bearing - b), b, {dy / (r * r), -dx / (r * r), -1.0}, kRadians, 0.01});
    }
  }
  std::shared_ptr<const Weigher> corrected(const DeviceBias& bias) const override {
    std::vector<Seen> without = seen_;
    for (Seen& s : without) {
      s.distance = bias.distance(s.distance);
      s.bearing = bias.bearing(s.bearing);
    }
    return std::make_shared<Reading>(without);
  }
  const std::vector<Seen>& seen() const { return seen_; }

 private:
  void weigh(const SampleView&, std::span<float>) const override {}
  std::vector<Seen> seen_;
};

/// A robot that goes in a circle of 3 m among four landmarks.
class Drive {
 public:
  explicit Drive(const DeviceBias& bias, std::uint64_t seed) : bias_(bias), random_(seed) {}

  std::vector<NewReading> read(std::size_t landmarks = 4) {
    constexpr std::array<std::array<double, 2>, 4> kPlaces = {{{6, 5}, {-5, 6}, {-6, -4}, {4, -7}}};
    std::vector<Seen> seen;
    for (std::size_t k = 0; k < landmarks; ++k) {
      const auto [x, y] = kPlaces[k];
      const double r = std::hypot(x - pose_.x, y - pose_.y);
      const double b = std::atan2(y - pose_.y, x - pose_.x) - pose_.theta;
      seen.push_back({x, y,
                      r * (1.0 + bias_.perMetre) + bias_.metres + kMetres * random_.gaussian(),
                      wrapAngle(b + bias_.radians + kRadians * random_.gaussian())});
    }
    return {{&feature_, ++sequence_, std::make_shared<Reading>(seen)}};
  }

  void step(std::size_t landmarks = 4) {
    ReadingsByTime news;
    news[1] = read(landmarks);
    biases.correct(news);
    last = news[1].front();
    biases.follow(news[1], estimate());
    if (!stands) {
      const Pose2 change{0.35, 0.0, 0.35 / 3.0};
      pose_ = pose_ * change;
      biases.move(changeOf(motion_, change, 1, ++step_));
    }
  }

  PoseEstimate estimate() const {
    PoseEstimate e;
    e.pose = pose_;
    e.covariance = {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.001};
    e.status = status;
    return e;
  }

  Biases biases;
  NewReading last;  ///< as it would be weighed
  bool stands = false;
  TrackStatus status = TrackStatus::kTracking;
  void setBias(const DeviceBias& bias) { bias_ = bias; }

 private:
  DeviceBias bias_;
  Random random_;
  ScalarData feature_{{"camera", "landmarks", "posts"}, {}, {}};
  OdometryMotion motion_;
  Pose2 pose_{3, 0, kTurn / 4};
  std::uint64_t sequence_ = 0;
  std::uint64_t step_ = 0;
};

TEST(Biases, AreLearnedFromADrive) {
  const DeviceBias truth{0.12, 0.03, 0.05};
  Drive drive(truth, 1);
  for (int i = 0; i < 300; ++i) drive.step();
  const auto known = drive.biases.known();
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known.begin()->first, "camera/landmarks");
  const DeviceBias bias = known.begin()->second;
  // Ranges are from 4 to 11 m: what counts is what is too much at 7 m.
  EXPECT_NEAR(bias.metres + 7 * bias.perMetre, truth.metres + 7 * truth.perMetre, 0.02);
  EXPECT_NEAR(bias.perMetre, truth.perMetre, 0.01);
  EXPECT_NEAR(bias.radians, truth.radians, 0.01);
  // What is weighed is without it, what was read stays at hand.
  const auto& corrected = dynamic_cast<const Reading&>(*drive.last.weigher).seen();
  const auto& read = dynamic_cast<const Reading&>(*drive.last.asRead).seen();
  for (std::size_t k = 0; k < read.size(); ++k) {
    EXPECT_NEAR(read[k].distance, corrected[k].distance * (1 + truth.perMetre) + truth.metres,
                0.03);
    EXPECT_NEAR(wrapAngle(read[k].bearing - corrected[k].bearing), truth.radians, 0.01);
  }
}

TEST(Biases, AreNoneWhereThereIsNone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Drive drive({}, seed);
    for (int i = 0; i < 300; ++i) {
      drive.step();
      ASSERT_TRUE(drive.biases.known().empty()) << "drive " << seed << ", step " << i;
      ASSERT_EQ(drive.last.asRead, nullptr);
    }
  }
}

TEST(Biases, AreNotLearnedByStanding) {
  Drive drive({0.5, 0.0, 0.2}, 2);
  drive.stands = true;
  for (int i = 0; i < 300; ++i) drive.step(1);
  EXPECT_TRUE(drive.biases.known().empty());
}

TEST(Biases, OfOneLandmarkAreNotTakenForTheWay) {
  // One landmark tells distance and direction alone; the rest is odometry's.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Drive drive({}, seed);
    for (int i = 0; i < 300; ++i) {
      drive.step(1);
      ASSERT_TRUE(drive.biases.known().empty()) << "drive " << seed << ", step " << i;
    }
  }
}

TEST(Biases, AreForgottenWithTheBelief) {
  Drive drive({0.3, 0.0, 0.0}, 3);
  for (int i = 0; i < 200; ++i) drive.step();
  ASSERT_FALSE(drive.biases.known().empty());
  drive.biases.forget();
  EXPECT_TRUE(drive.biases.known().empty());
  for (int i = 0; i < 200; ++i) drive.step();
  EXPECT_FALSE(drive.biases.known().empty());
}

void expectKnown(const Drive& drive, double metres) {
  const auto known = drive.biases.known();
  ASSERT_EQ(known.size(), 1U);
  EXPECT_NEAR(known.begin()->second.metres + 7 * known.begin()->second.perMetre, metres, 0.02);
}

TEST(Biases, ThatAreKnownOutliveThePlace) {
  Drive drive({0.3, 0.0, 0.0}, 3);
  for (int i = 0; i < 200; ++i) drive.step();
  drive.biases.forgetPlace();
  expectKnown(drive, 0.3);
  // They go on to be learned from the new place, and are taken off all the while.
  for (int i = 0; i < 200; ++i) {
    drive.step();
    ASSERT_NE(drive.last.asRead, nullptr);
  }
  expectKnown(drive, 0.3);
}

TEST(Biases, ThatAreNotKnownYetGoOnToBeLearnedFromAnotherPlace) {
  // Nearly all of what makes it known was seen before the place was forgotten.
  Drive drive({0.3, 0.0, 0.0}, 3);
  int until = 0;
  for (; drive.biases.known().empty(); ++until) drive.step();
  Drive again({0.3, 0.0, 0.0}, 3);
  for (int i = 2; i < until; ++i) again.step();
  again.biases.forgetPlace();
  ASSERT_TRUE(again.biases.known().empty());
  int after = 0;
  for (; again.biases.known().empty() && after < until; ++after) again.step();
  EXPECT_LT(after, until / 2 + 1) << until;
}

/// Drives, with another bias than the one that is known, until that changes.
int stepsUntilForgotten(Drive& drive, const DeviceBias& other) {
  drive.setBias(other);
  int steps = 0;
  while (!drive.biases.known().empty() && steps < 1000) {
    drive.step();
    ++steps;
  }
  return steps;
}

TEST(Biases, OfWhichHalfFitNoLongerAreForgottenIfFewValuesEverFitted) {
  // Each step has eight values, so 20 steps are fewer than 300.
  Drive few({0.6, 0.0, 0.0}, 5);
  for (int i = 0; i < 20; ++i) few.step();
  ASSERT_FALSE(few.biases.known().empty());
  EXPECT_LE(stepsUntilForgotten(few, {-9.0, 0.0, 2.0}), 6);
  Drive many({0.6, 0.0, 0.0}, 5);
  for (int i = 0; i < 200; ++i) many.step();
  // It outlives its place once, but is not taken up again.
  many.setBias({-9.0, 0.0, 2.0});
  for (int i = 0; i < 7; ++i) many.step();
  EXPECT_FALSE(many.biases.known().empty());
  EXPECT_LT(stepsUntilForgotten(many, {-9.0, 0.0, 2.0}), 60);
}

TEST(Biases, WithWhichNoPlaceIsTrackedAreForgotten) {
  Drive drive({0.3, 0.0, 0.0}, 3);
  for (int i = 0; i < 200; ++i) drive.step();
  drive.biases.forgetPlace();
  drive.status = TrackStatus::kLost;
  // Eight values a step: 300 are reached at the 38th.
  for (int i = 0; i < 37; ++i) drive.step();
  expectKnown(drive, 0.3);
  drive.step();
  EXPECT_TRUE(drive.biases.known().empty());
}

TEST(Biases, AreNotLearnedWhereTheRobotIsNotTracked) {
  Drive drive({0.3, 0.0, 0.0}, 4);
  for (int i = 0; i < 100; ++i) {
    const std::vector<NewReading> news = drive.read();
    ReadingsByTime byTime{{1, news}};
    drive.biases.correct(byTime);
    PoseEstimate unsure = drive.estimate();
    unsure.status = TrackStatus::kUncertain;
    drive.biases.follow(byTime[1], unsure);
  }
  EXPECT_TRUE(drive.biases.known().empty());
}

}  // namespace
}  // namespace ortung

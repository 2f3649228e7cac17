#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "FakeRoom.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung::test {

/// A robot in the room with a laser and landmarks in sight, driving a curve, with drifting
/// odometry. Ten readings a second.
class FakeRun {
 public:
  static constexpr double kPeriod = 0.1;

  /// @param hasPosts or the laser is alone
  explicit FakeRun(bool hasPosts = true) {
    container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
    data_ = &container.add(
        std::make_unique<ScanData>(SensorId{"LMS200", "LRF", "scan"}, Pose2{0.1, 0, 0}, scan));
    learnEverywhere(*data_, region, kPi / 90,
                    [this](const Pose2& s) { return scanWords(room, s, scan); });
    if (!hasPosts) return;
    posts_ = &container.add(
        std::make_unique<LandmarksData>(SensorId{"cam", "camera", "posts"}, Pose2{}, landmarks));
    learnEverywhere(*posts_, region, kPi / 90,
                    [this](const Pose2& s) { return landmarkWords(points, s, 20.0); });
  }

  static constexpr double kSpeed = 0.5;  ///< [m/s]
  static constexpr double kTurn = 0.35;  ///< [rad/s]

  /// A pose from which drive() goes round the point (x, y), @p phase [rad] round already.
  static Pose2 onCircle(double x, double y, double phase) {
    const double radius = kSpeed / kTurn;
    return {x + radius * std::cos(phase), y + radius * std::sin(phase), wrapAngle(phase + kPi / 2)};
  }

  /// Begins anew at @p start with noise of its own.
  void begin(const Pose2& start, std::uint64_t seed) {
    truth = start;
    odometry_ = {};
    truths_.clear();
    random_ = Random(seed);
  }

  /// One period: drives a piece of the circle, or of another way, then reads everything.
  void drive(double speed = kSpeed, double turn = kTurn) {
    const Pose2 change{speed * kPeriod, 0, turn * kPeriod};
    truths_.push_back(truth);
    truth = truth * change;
    odometry_ = odometry_ *
                Pose2{(odometryScale * change.x + spin * kPeriod) * (1 + 0.02 * random_.gaussian()),
                      0, change.theta + 0.004 * random_.gaussian()};
    stamp += fromSeconds(kPeriod);
    readAll();
  }

  void readAll() {
    const Words scanned = scanNow();
    if (tellsOdometry)
      container.set(
          {stamp, {"base", "odometry", "pose"}, OdometryData::encode({odometry_, 0, 0, {}})});
    if (!reads) return;
    container.set({stamp, {"LMS200", "LRF", "scan"}, scanned});
    if (posts_ != nullptr)
      container.set({stamp,
                     {"cam", "camera", "posts"},
                     landmarkWords(points, seen(), 20.0, &random_, 0.05, 0.02)});
  }

  MclConfig config() const {
    MclConfig c;
    c.maxSamples = 4000;
    c.minSamples = 500;
    return c;
  }
  std::unique_ptr<Mcl> mcl(const MclConfig& c) const {
    return std::make_unique<Mcl>(c, region, std::make_unique<OdometryMotion>());
  }

  const Room room{8, 5};
  const FieldRegion region = room.region(0.1, 0.2);
  const std::vector<Point> points = {{1, 3.5, 2.0}, {2, -3.0, -2.2}};
  const ScanData::Config scan{
      .beams = 91, .firstAngle = -kPi / 2, .angleStep = kPi / 90, .maxRange = 9.0};
  const LandmarksData::Config landmarks{.identities = {1, 2},
                                        .maxRange = 20.0,
                                        .fieldOfView = 0.0,
                                        .range = {.sigma = 0.1},
                                        .bearing = {.sigma = 0.05}};
  SensorContainer container;
  Pose2 truth;
  Timestamp stamp = 0;
  bool tellsOdometry = true;
  bool reads = true;           ///< whether there are readings beside odometry
  double odometryScale = 1.0;  ///< of the ways that odometry says
  double spin = 0.0;     ///< speed of wheels that spin: counted by odometry, but not driven [m/s]
  std::size_t late = 0;  ///< periods by which stamps of readings are

 private:
  using Words = std::vector<std::uint32_t>;
  Pose2 seen() const {
    const std::size_t back = std::min(late, truths_.size());
    return back == 0 ? truth : truths_[truths_.size() - back];
  }
  Words scanNow() {
    const Pose2 sensor = seen() * data_->mount();
    std::vector<float> ranges;
    for (int i = 0; i < scan.beams; ++i) {
      const double range =
          room.range(sensor.x, sensor.y, sensor.theta + scan.firstAngle + i * scan.angleStep);
      ranges.push_back(static_cast<float>(range + 0.02 * random_.gaussian()));
    }
    Words words;
    ScanData::encode(ranges, scan.maxRange, words);
    return words;
  }
  SensorData* data_ = nullptr;
  SensorData* posts_ = nullptr;
  Pose2 odometry_;
  std::vector<Pose2> truths_;  ///< up to the period before
  Random random_{1};
};

}  // namespace ortung::test

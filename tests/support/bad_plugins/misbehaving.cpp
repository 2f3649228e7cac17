#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>

#include "ortung/core/Extractor.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/motion/MotionMoments.hpp"
#include "ortung/sim_api/Drive.hpp"
#include "ortung/sim_api/Player.hpp"
#include "ortung/sim_api/Sensor.hpp"

/// Plugins of every kind that do as their settings say: `where` (a function, or "construct"), `how`
/// ("throw", "int", "nan", "huge", "loop") and `after` (calls of that function that go well).
namespace ortung {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class Mischief {
 public:
  explicit Mischief(const Parameters& p)
      : where_(p.textOr("where", "")),
        how_(p.textOr("how", "throw")),
        left_(p.integerOr("after", 0, {0, 1'000'000})) {
    p.textOr("plugin", "");
    at("construct", 0.0);
  }

  /// @returns @p value, or what the settings say instead
  double at(const char* where, double value) {
    if (where_ != where || left_-- > 0) return value;
    if (how_ == "throw") throw std::runtime_error("a wheel came off");
    if (how_ == "int") throw 7;
    if (how_ == "nan") return kNan;
    if (how_ == "huge") return 1e12;
    while (how_ == "loop") std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return value;
  }

 private:
  std::string where_;
  std::string how_;
  std::int64_t left_;
};

DeviceData makeData(const Parameters& p) {
  [[maybe_unused]] const Mischief asked(p);  // its settings are known and checked
  DeviceData data;
  data.push_back(std::make_unique<PoseData>(SensorId{"bad", "misbehaving", "pose"}));
  return data;
}

class BadSensor : public Sensor {
 public:
  explicit BadSensor(const Parameters& p) : mischief_(p) {}
  void generateData(const World&, const RobotState& robot, Random*, Timestamp now,
                    std::span<SensorData* const> data) override {
    Pose2 pose = robot.pose;
    pose.x = mischief_.at("generateData", pose.x);
    data[0]->setData(now, PoseData::encode(pose));
  }
  double period() const override { return mischief_.at("period", 0.0); }
  double rays() const override { return mischief_.at("rays", 1.0); }

 private:
  mutable Mischief mischief_;
};

DeviceData makeRange(const Parameters& p) {
  [[maybe_unused]] const Mischief asked(p);  // its settings are known and checked
  DeviceData data;
  data.push_back(std::make_unique<ScalarData>(SensorId{"bad", "misbehaving", "range"}, Pose2{},
                                              ScalarData::Config{}));
  return data;
}

/// Measures a metre everywhere.
class BadRange : public Sensor {
 public:
  explicit BadRange(const Parameters& p) : mischief_(p) {}
  void generateData(const World&, const RobotState&, Random*, Timestamp now,
                    std::span<SensorData* const> data) override {
    const std::uint32_t word = words::fromMetres(mischief_.at("generateData", 1.0));
    data[0]->setData(now, {&word, 1});
  }

 private:
  Mischief mischief_;
};

class BadDrive : public Drive {
 public:
  explicit BadDrive(const Parameters& p) : mischief_(p) {}
  void setTranslationalVelocity(double v) override {
    wanted_ = mischief_.at("setTranslationalVelocity", v);
  }
  void setRotationalVelocity(double w) override { mischief_.at("setRotationalVelocity", w); }
  void setCommand(std::span<const double> c) override {
    wanted_ = mischief_.at("setCommand", c[0]);
  }
  std::size_t commandSize() const override { return 1; }
  std::string kind() const override { return "speed"; }
  std::string commandHelp() const override { return "[speed m/s]"; }
  DriveLimits limits() const override { return {mischief_.at("limits", 1.0)}; }
  Pose2 relocate(double dt, Random*) override {
    constexpr double kAcceleration = 1.0;  // [m/s^2]
    speed_ += std::clamp(wanted_ - speed_, -kAcceleration * dt, kAcceleration * dt);
    return {mischief_.at("relocate", speed_ * dt), 0.0, 0.0};
  }
  Twist velocity() const override { return {mischief_.at("velocity", speed_), 0.0, 0.0}; }
  void setVelocity(const Twist& velocity) override {
    speed_ = mischief_.at("setVelocity", velocity.x);
  }
  Pose2 measure(const Pose2& change, Random*) override {
    return {mischief_.at("measure", change.x), change.y, change.theta};
  }
  Twist measuredVelocity(bool) const override {
    return {mischief_.at("measuredVelocity", speed_), 0.0, 0.0};
  }
  std::span<const std::uint32_t> motionData() const override {
    mischief_.at("motionData", 0.0);
    return {};
  }

 private:
  mutable Mischief mischief_;
  double wanted_ = 0.3;  ///< [m/s]
  double speed_ = 0.0;   ///< [m/s]
};

DeviceData makeExtracted(const Parameters& p) {
  [[maybe_unused]] const Mischief asked(p);  // its settings are known and checked
  DeviceData data;
  data.push_back(std::make_unique<PoseData>(SensorId{"bad", "extracted", "pose"}));
  return data;
}

class BadExtractor : public Extractor {
 public:
  explicit BadExtractor(const Parameters& p) : mischief_(p) {}
  std::vector<std::string> inputs() const override {
    mischief_.at("inputs", 0.0);
    return {"*/odometry/*"};
  }
  void take(std::span<const SensorData* const>) override { mischief_.at("take", 0.0); }
  void extract(const FieldModel&, std::span<std::optional<Words>> words) override {
    words[0] = PoseData::encode({mischief_.at("extract", 0.0), 0.0, 0.0});
  }

 private:
  mutable Mischief mischief_;
};

class BadMotion : public MotionModel, public MotionMoments {
 public:
  explicit BadMotion(const Parameters& p) : mischief_(p) {}
  void follow(Timestamp stamp, const OdometryView& reading) override {
    mischief_.at("follow", 0.0);
    MotionModel::follow(stamp, reading);
  }
  std::optional<Pose2> odometryAt(Timestamp stamp) const override {
    auto pose = MotionModel::odometryAt(stamp);
    if (pose) pose->y = mischief_.at("odometryAt", pose->y);
    return pose;
  }
  void sampleMotion(const MovableSamples& samples, const Pose2& change, std::uint64_t,
                    std::uint64_t, std::uint64_t) const override {
    for (float& x : samples.x) x += static_cast<float>(change.x);
    if (!samples.x.empty())
      samples.x.back() = static_cast<float>(mischief_.at("sampleMotion", samples.x.back()));
  }
  std::optional<MotionChange> moments(const Pose2& change) const override {
    MotionChange its{change, {}};
    its.covariance[4] = mischief_.at("moments", 0.0);
    return its;
  }
  double endLearning() override { return mischief_.at("endLearning", -1.0); }

 private:
  mutable Mischief mischief_;
};

/// When it ends it writes its robot's name into the file `notes`, a line each.
class BadPlayer : public Player {
 public:
  explicit BadPlayer(const Parameters& p) : mischief_(p), notes_(p.textOr("notes", "")) {}
  void begin(PlayerSeat&) override { mischief_.at("begin", 0.0); }
  bool senseAndAct(PlayerSeat&) override { return mischief_.at("senseAndAct", 1.0) > 0.0; }
  void end(PlayerSeat& seat) override {
    mischief_.at("end", 0.0);
    if (!notes_.empty()) std::ofstream(notes_, std::ios::app) << seat.name() << '\n';
  }

 private:
  Mischief mischief_;
  std::string notes_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("misbehaving", ortung::provideData<ortung::makeData>("misbehaving"),
               ortung::provide<ortung::Sensor, ortung::BadSensor>("misbehaving"),
               ortung::provide<ortung::Drive, ortung::BadDrive>("misbehaving"),
               ortung::provide<ortung::MotionModel, ortung::BadMotion>("misbehaving"),
               ortung::provide<ortung::Player, ortung::BadPlayer>("misbehaving"),
               ortung::provideData<ortung::makeRange>("misbehaving_range"),
               ortung::provide<ortung::Sensor, ortung::BadRange>("misbehaving_range"),
               ortung::provideData<ortung::makeExtracted>("misbehaving_extracted"),
               ortung::provide<ortung::Extractor, ortung::BadExtractor>("misbehaving_extracted"));

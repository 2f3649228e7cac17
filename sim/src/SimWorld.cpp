#include "ortung/sim/SimWorld.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

#include "FreeSpace.hpp"
#include "RayCaster.hpp"
#include "WorldModel.hpp"
#include "ortung/container/Parameters.hpp"

namespace ortung {

SimWorld::~SimWorld() = default;

namespace {

constexpr std::size_t kMaxRobots = 4096;
constexpr Range kRobotSize{0.01, 100.0};  ///< [m]

bool isWithin(double value, const Range& range) {
  return value >= range.low && value <= range.high;
}

bool isSane(const RayFan& fan) {
  for (const double value : {fan.x, fan.y, fan.z, fan.firstAngle, fan.angleStep, fan.elevation})
    if (!std::isfinite(value)) return false;
  return fan.maxRange >= 0.0 && std::isfinite(fan.maxRange);
}

class ModelledWorld final : public SimWorld {
 public:
  explicit ModelledWorld(WorldModel model)
      : model_(std::move(model)),
        fingerprint_(fingerprintOf(model_)),
        space_(model_),
        rays_(makeMesh(model_)),
        lines_(linesOf(model_)) {
    for (const Primitive& primitive : model_.primitives)
      if (primitive.isSolid()) objects_.push_back(objectOf(primitive));
    fixedObjects_ = objects_.size();
  }

  const std::string& name() const override { return model_.name; }
  std::string fingerprint() const override { return fingerprint_; }
  FieldRegion region(double cell, double robotRadius) const override {
    return space_.region(cell, robotRadius);
  }
  std::span<const Landmark> landmarks() const override { return model_.landmarks; }
  std::span<const FieldLine> lines() const override { return lines_; }
  std::span<const WorldObject> objects() const override { return objects_; }
  const PhysicsConfig& physics() const override { return model_.physics; }
  bool isFree(double x, double y, double radius) const override {
    return space_.isFree(x, y, radius);
  }

  void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const override {
    if (!isSane(fan)) {
      std::fill(ranges.begin(), ranges.end(),
                fan.maxRange > 0.0 ? static_cast<float>(fan.maxRange) : 0.0f);
      return;
    }
    placeRobots();
    rays_.castFan(fan, ignore, ranges);
  }

  bool isVisible(double x0, double y0, double z0, double x1, double y1, double z1,
                 RobotNumber ignore, double slack) const override {
    const std::array<double, 3> way{x1 - x0, y1 - y0, z1 - z0};
    const double length = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    if (!std::isfinite(length) || std::isnan(slack)) return false;
    if (length <= slack) return true;
    placeRobots();
    return !rays_.isBlocked({x0, y0, z0}, {way[0] / length, way[1] / length, way[2] / length},
                            length - slack, ignore);
  }

  RobotNumber addRobot(double radius, double height) override {
    if (!isWithin(radius, kRobotSize) || !isWithin(height, kRobotSize))
      throw std::invalid_argument("a robot of radius " + std::to_string(radius) + " m and height " +
                                  std::to_string(height) + " m, expected both in [0.01, 100]");
    if (robots_.size() >= kMaxRobots)
      throw std::invalid_argument("there are " + std::to_string(kMaxRobots) +
                                  " robots already, which is the most");
    ++lastNumber_;
    robots_[lastNumber_] = {{{}, radius, radius, 0.0, 0.0, height, lastNumber_}, false};
    return lastNumber_;
  }

  void moveRobot(RobotNumber robot, const Pose2& pose) override {
    if (!isFinite(pose)) throw std::invalid_argument("a robot's pose that is not finite");
    Robot& moved = find(robot)->second;
    moved.body.centre = {pose.x, pose.y};
    moved.isPlaced = true;
    stale_.store(true, std::memory_order_release);
  }

  void removeRobot(RobotNumber robot) override {
    robots_.erase(find(robot));
    stale_.store(true, std::memory_order_release);
  }

 private:
  struct Robot {
    RoundBody body;
    bool isPlaced = false;
  };

  std::map<RobotNumber, Robot>::iterator find(RobotNumber robot) {
    const auto found = robots_.find(robot);
    if (found == robots_.end())
      throw std::invalid_argument("there is no robot " + std::to_string(robot));
    return found;
  }

  // All robots move before anybody looks, so the work is left to the first query after that; others
  // may query at the same time.
  void placeRobots() const {
    if (!stale_.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(placing_);
    if (!stale_.load(std::memory_order_relaxed)) return;
    std::vector<RoundBody> bodies;
    for (const auto& [number, robot] : robots_)
      if (robot.isPlaced) bodies.push_back(robot.body);
    rays_.setRobots(bodies);
    stale_.store(false, std::memory_order_release);
  }

  WorldModel model_;
  std::string fingerprint_;
  FreeSpace space_;
  mutable RayCaster rays_;
  std::vector<FieldLine> lines_;
  std::vector<WorldObject> objects_;  ///< first what is fixed, then what moves
  std::size_t fixedObjects_ = 0;
  std::map<RobotNumber, Robot> robots_;
  RobotNumber lastNumber_ = 0;
  mutable std::atomic<bool> stale_{false};
  mutable std::mutex placing_;
};

}  // namespace

std::unique_ptr<SimWorld> readWorld(const std::filesystem::path& file) {
  WorldModel model = readWorldModel(file);
  try {
    return std::make_unique<ModelledWorld>(std::move(model));
  } catch (const std::runtime_error& error) {
    throw ConfigError(file.string() + ": " + error.what());
  } catch (const std::logic_error& error) {  // too many walls
    throw ConfigError(file.string() + ": " + error.what());
  }
}

}  // namespace ortung

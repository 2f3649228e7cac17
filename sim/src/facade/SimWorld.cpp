#include "ortung/sim/SimWorld.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "BodyRays.hpp"
#include "Cones.hpp"
#include "FloorCut.hpp"
#include "FreeSpace.hpp"
#include "MapWalls.hpp"
#include "Painters.hpp"
#include "RayCaster.hpp"
#include "SightTracer.hpp"
#include "WorldModel.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

SimWorld::~SimWorld() = default;
void SimWorld::markBody(RobotNumber, const std::string&) {}
std::shared_ptr<const FieldModel> SimWorld::field() const {
  return std::make_shared<const FieldModel>(fieldModelOf(*this));
}

namespace {

constexpr std::size_t kMaxBodies = 4096;
constexpr std::size_t kFewRobots = 2;     ///< number of robots for which there is room at first
constexpr Range kBodySize{0.001, 100.0};  ///< size of a moving body's pieces [m]

bool isSane(const RayFan& fan) {
  for (const double value : {fan.x, fan.y, fan.z, fan.firstAngle, fan.angleStep, fan.elevation})
    if (!std::isfinite(value)) return false;
  return fan.maxRange >= 0.0 && std::isfinite(fan.maxRange);
}

bool isSane(const ConeFan& fan) {
  for (const double value : {fan.x, fan.y, fan.z, fan.firstAngle, fan.angleStep})
    if (!std::isfinite(value)) return false;
  return fan.maxRange >= 0.0 && std::isfinite(fan.maxRange) && fan.halfAngle > 0.0 &&
         fan.halfAngle < 1.5;
}

/// A number that no moving body has.
constexpr RobotNumber kFixed = std::numeric_limits<RobotNumber>::max();

/// The fixed part of a world, which all its copies share. Thread-safe: immutable, except for the
/// painters, the tracer, and what is made when it is first asked for, which are thread-safe.
struct Ground {
  explicit Ground(WorldModel read)
      : model(std::move(read)),
        fingerprint(fingerprintOf(model)),
        space(model),
        rays(makeMesh(model)),
        lines(linesOf(model)) {
    for (const Primitive& primitive : model.primitives)
      if (primitive.isSolid()) {
        objects.push_back(objectOf(primitive));
        solids.add({&primitive, 1}, kFixed, {});
      }
    for (const GridBody& body : model.grids) addMapWalls(body, mapWalls);
  }
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;

  WorldModel model;
  std::string fingerprint;
  FreeSpace space;
  RayCaster rays;
  std::vector<FieldLine> lines;
  std::vector<FieldWall> mapWalls;
  std::vector<WorldObject> objects;
  BodyRays solids;  ///< fixed bodies except maps, for cones
  mutable Painters painters;
  mutable SightTracer tracer;
  mutable std::once_flag hasField;
  mutable std::shared_ptr<const FieldModel> field;
};

class ModelledWorld final : public SimWorld {
 public:
  explicit ModelledWorld(std::shared_ptr<const Ground> ground) : ground_(std::move(ground)) {
    objects_.reserve(ground_->objects.size() + movables().size() + kFewRobots);
    objects_.assign(ground_->objects.begin(), ground_->objects.end());
  }

  std::unique_ptr<SimWorld> another() const override {
    return std::make_unique<ModelledWorld>(ground_);
  }

  const std::string& name() const override { return ground_->model.name; }
  std::string fingerprint() const override { return ground_->fingerprint; }
  FieldRegion region(double cell, const RobotSize& robot) const override {
    FieldRegion region = ground_->space.region(cell, robot);
    for (const GridBody& body : ground_->model.grids)
      region.surfaceSigma =
          std::max(region.surfaceSigma, std::hypot(body.map.cell / std::sqrt(12.0), body.mapError));
    region.building = building();
    return region;
  }
  std::span<const Landmark> landmarks() const override { return ground_->model.landmarks; }
  std::span<const FieldLine> lines() const override { return ground_->lines; }
  std::span<const WorldObject> objects() const override { return objects_; }
  std::span<const FieldWall> mapWalls() const override { return ground_->mapWalls; }
  const PhysicsConfig& physics() const override { return ground_->model.physics; }
  bool isFree(double x, double y, const RobotSize& size) const override {
    return ground_->space.isFree(x, y, size);
  }

  void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const override {
    if (!isSane(fan)) {
      std::fill(ranges.begin(), ranges.end(),
                fan.maxRange > 0.0 ? static_cast<float>(fan.maxRange) : 0.0f);
      return;
    }
    ground_->rays.castFan(fan, ranges);
    bodies_.castFan(fan, ignore, ranges);
    if (!building().isEmpty()) cutAtFloor(building(), fan, ranges);
  }

  void castCones(const ConeFan& fan, RobotNumber ignore, std::span<float> ranges) const override {
    std::fill(ranges.begin(), ranges.end(),
              fan.maxRange > 0.0 ? static_cast<float>(fan.maxRange) : 0.0f);
    if (!isSane(fan)) return;
    if (!ground_->model.grids.empty())
      castConesAtMaps(*this, ground_->model.grids, fan, ignore, ranges);
    ground_->solids.castCones(fan, 0, ranges);
    bodies_.castCones(fan, ignore, ranges);
    if (!building().isEmpty()) castConesOnFloor(fan, ignore, ranges);
  }

  bool isVisible(double x0, double y0, double z0, double x1, double y1, double z1,
                 RobotNumber ignore, double slack) const override {
    const std::array<double, 3> way{x1 - x0, y1 - y0, z1 - z0};
    const double length = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    if (!std::isfinite(length) || std::isnan(slack)) return false;
    if (!building().isEmpty() && building().floorAt(x0) != building().floorAt(x1)) return false;
    if (length <= slack) return true;
    const std::array<double, 3> from{x0, y0, z0};
    const std::array<double, 3> direction{way[0] / length, way[1] / length, way[2] / length};
    return !ground_->rays.isBlocked(from, direction, length - slack) &&
           !bodies_.isBlocked(from, direction, length - slack, ignore);
  }

  void draw(const Drawing& drawing, const Sheet& sheet) const override {
    ground_->painters.draw(ground_->model, objects_, ground_->objects.size(), drawing, sheet);
  }
  void trace(const Sight& sight, const Traced& traced) const override {
    ground_->tracer.trace(ground_->model, objects_, ground_->objects.size(), sight, traced);
  }

  RobotNumber addBody(const MovingBody& body, const Pose2& pose) override {
    checkPieces(body.pieces);
    if (!isFinite(pose)) throw std::invalid_argument("a body's pose that is not finite");
    if (numbers_.size() >= kMaxBodies)
      throw std::invalid_argument("there are " + std::to_string(kMaxBodies) +
                                  " moving bodies already, which is the most");
    const RobotNumber number = ++lastNumber_;
    WorldObject object;
    object.kind = body.kind;
    object.name = body.name;
    object.colour = body.colour;
    object.isMovable = true;
    object.robot = body.kind == "robot" ? number : 0;
    object.pose = pose;
    measure(body.pieces, object);
    numbers_.push_back(number);
    objects_.push_back(std::move(object));
    bodies_.add(body.pieces, number, pose);
    return number;
  }

  void moveBody(RobotNumber body, const Pose2& pose, const Twist& velocity) override {
    if (!isFinite(pose)) throw std::invalid_argument("a body's pose that is not finite");
    const std::size_t place = find(body);
    objects_[ground_->objects.size() + place].pose = pose;
    objects_[ground_->objects.size() + place].velocity = velocity;
    bodies_.move(place, pose);
  }

  void reshapeBody(RobotNumber body, std::span<const Primitive> pieces) override {
    const std::size_t place = find(body);
    checkPieces(pieces);
    bodies_.reshape(place, pieces);
    measure(pieces, objects_[ground_->objects.size() + place]);
  }

  void markBody(RobotNumber body, const std::string& team) override {
    objects_[ground_->objects.size() + find(body)].team = team;
  }

  void removeBody(RobotNumber body) override {
    const std::size_t place = find(body);
    bodies_.remove(place);
    objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(ground_->objects.size() + place));
    numbers_.erase(numbers_.begin() + static_cast<std::ptrdiff_t>(place));
  }

  Solids solids() const override {
    Solids solids;
    solids.bounds = ground_->model.bounds;
    for (const Primitive& primitive : ground_->model.primitives)
      if (primitive.isSolid()) solids.primitives.push_back(primitive);
    for (const GridBody& body : ground_->model.grids)
      forOutline(body, [&](const Point2& from, const Point2& to) {
        solids.walls.push_back({from, to, body.zLow, body.zHigh});
      });
    return solids;
  }
  std::span<const Primitive> movables() const override { return ground_->model.movables; }
  std::shared_ptr<const FieldModel> field() const override {
    std::call_once(ground_->hasField, [&] { ground_->field = SimWorld::field(); });
    return ground_->field;
  }

 private:
  const Building& building() const { return ground_->model.building; }

  /// Casts cones anew that may have met something on another floor, as rays, which know where their
  /// floor ends.
  void castConesOnFloor(const ConeFan& fan, RobotNumber ignore, std::span<float> ranges) const {
    const double border = toBorder(building(), fan.x);
    const auto goesBeyond = [&](float range) {
      return static_cast<double>(range) > border && range < static_cast<float>(fan.maxRange);
    };
    if (std::none_of(ranges.begin(), ranges.end(), goesBeyond)) return;
    std::vector<float> rays(ranges.size());
    World::castCones(fan, ignore, rays);
    for (std::size_t i = 0; i < ranges.size(); ++i)
      if (goesBeyond(ranges[i])) ranges[i] = rays[i];
  }

  static void checkPieces(std::span<const Primitive> pieces) {
    if (pieces.empty()) throw std::invalid_argument("a moving body has no pieces");
    for (const Primitive& piece : pieces) {
      const Box2 box = boundsOf(piece);
      const double least = piece.shape == Primitive::Shape::kTriangle
                               ? std::min(box.xHigh - box.xLow, box.yHigh - box.yLow)
                               : 2.0 * std::min(piece.halfX, piece.halfY);
      const double height = piece.zHigh - piece.zLow;
      for (const double coordinate : {box.xLow, box.xHigh, box.yLow, box.yHigh, piece.zLow})
        if (!(std::abs(coordinate) <= kBodySize.high))
          throw std::invalid_argument("a piece of a moving body is " + std::to_string(coordinate) +
                                      " m away from its middle, expected at most 100");
      if (!(least >= kBodySize.low) || !(height >= kBodySize.low && height <= kBodySize.high))
        throw std::invalid_argument("a piece of a moving body is " + std::to_string(least) +
                                    " m wide and " + std::to_string(height) +
                                    " m high, expected 0.001 to 100");
    }
  }

  /// Measures the extent of a body around its own origin.
  static void measure(std::span<const Primitive> pieces, WorldObject& object) {
    object.pieces = worldPiecesOf(pieces);
    object.halfX = object.halfY = object.radius = 0.0;
    object.zLow = pieces.front().zLow;
    object.zHigh = pieces.front().zHigh;
    object.isRound = pieces.size() == 1 && pieces.front().shape == Primitive::Shape::kEllipse;
    for (const Primitive& piece : pieces) {
      const Box2 box = boundsOf(piece);
      object.halfX = std::max({object.halfX, std::abs(box.xLow), std::abs(box.xHigh)});
      object.halfY = std::max({object.halfY, std::abs(box.yLow), std::abs(box.yHigh)});
      object.zLow = std::min(object.zLow, piece.zLow);
      object.zHigh = std::max(object.zHigh, piece.zHigh);
      object.radius = std::max(object.radius, reachOf(piece));
    }
  }

  std::size_t find(RobotNumber body) const {
    const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), body);
    if (found == numbers_.end() || *found != body)
      throw std::invalid_argument("there is no moving body " + std::to_string(body));
    return static_cast<std::size_t>(found - numbers_.begin());
  }

  std::shared_ptr<const Ground> ground_;
  std::vector<WorldObject> objects_;  ///< all objects: first fixed, then moving ones
  BodyRays bodies_;
  /// Numbers of the moving bodies in the order of objects_, ascending.
  std::vector<RobotNumber> numbers_;
  RobotNumber lastNumber_ = 0;
};

}  // namespace

namespace {

std::unique_ptr<SimWorld> build(WorldModel model, const std::string& where) {
  try {
    return std::make_unique<ModelledWorld>(std::make_shared<const Ground>(std::move(model)));
  } catch (const std::runtime_error& error) {
    throw ConfigError(where + ": " + error.what());
  } catch (const std::logic_error& error) {  // too many walls
    throw ConfigError(where + ": " + error.what());
  }
}

}  // namespace

std::unique_ptr<SimWorld> readWorld(const std::filesystem::path& file) {
  return build(readWorldModel(file), file.string());
}

std::unique_ptr<SimWorld> readWorld(const Parameters& toml, const std::string& name,
                                    const std::filesystem::path& folder) {
  return build(readWorldModel(toml, name, folder), toml.where());
}

}  // namespace ortung

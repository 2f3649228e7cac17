#include "BareBox2d.hpp"

#include <cmath>
#include <numbers>

#include "ArenaStarts.hpp"

namespace ortung::bench {
namespace {

constexpr float kMaxRange = 8.0f;  // [m]
constexpr int kBeams = 180;

/// The nearest hit that is not the robot itself.
class Nearest : public b2RayCastCallback {
 public:
  explicit Nearest(const b2Body* self) : self_(self) {}
  float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float fraction) override {
    if (fixture->GetBody() == self_) return -1.0f;
    fraction_ = fraction;
    return fraction;
  }
  float fraction() const { return fraction_; }

 private:
  const b2Body* self_;
  float fraction_ = 1.0f;
};

void addBox(b2World& world, float x, float y, float halfX, float halfY) {
  b2BodyDef definition;
  definition.position = {x, y};
  b2PolygonShape box;
  box.SetAsBox(halfX, halfY);
  world.CreateBody(&definition)->CreateFixture(&box, 0.0f);
}

}  // namespace

BareBox2d::BareBox2d(std::size_t robots) {
  addBox(world_, 0.0f, 6.05f, 9.1f, 0.05f);
  addBox(world_, 0.0f, -6.05f, 9.1f, 0.05f);
  addBox(world_, 9.05f, 0.0f, 0.05f, 6.0f);
  addBox(world_, -9.05f, 0.0f, 0.05f, 6.0f);
  const float boxes[8][2] = {{-7.2f, -4.6f}, {-7.2f, 4.6f}, {7.2f, -4.6f}, {7.2f, 4.6f},
                             {-2.0f, 0.0f},  {2.0f, 0.0f},  {0.0f, -4.9f}, {0.0f, 4.9f}};
  for (const auto& box : boxes) addBox(world_, box[0], box[1], 0.3f, 0.3f);
  b2PolygonShape shape;
  shape.SetAsBox(0.2f, 0.2f);
  for (std::size_t i = 0; i < robots; ++i) {
    const ArenaStart& start = kArenaStarts[i];
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.position = {static_cast<float>(start.x), static_cast<float>(start.y)};
    definition.angle = static_cast<float>(start.thetaDeg * std::numbers::pi / 180.0);
    definition.allowSleep = false;
    b2Body* body = world_.CreateBody(&definition);
    body->CreateFixture(&shape, 60.0f);
    robots_.push_back(body);
  }
}

void BareBox2d::step() {
  for (b2Body* robot : robots_) {
    const float angle = robot->GetAngle();
    robot->SetLinearVelocity({0.3f * std::cos(angle), 0.3f * std::sin(angle)});
    robot->SetAngularVelocity(1.0f);
  }
  world_.Step(0.01f, 8, 3);
}

void BareBox2d::cast(std::vector<float>& ranges) const {
  ranges.clear();
  for (const b2Body* robot : robots_) {
    const b2Vec2 from = robot->GetPosition();
    for (int i = 0; i < kBeams; ++i) {
      const auto angle = static_cast<float>(robot->GetAngle() - std::numbers::pi / 2.0 +
                                            i * std::numbers::pi / (kBeams - 1));
      Nearest nearest(robot);
      world_.RayCast(&nearest, from, from + kMaxRange * b2Vec2(std::cos(angle), std::sin(angle)));
      ranges.push_back(nearest.fraction() * kMaxRange);
    }
  }
}

}  // namespace ortung::bench

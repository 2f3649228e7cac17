#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "BoxShapes.hpp"
#include "Contacts.hpp"
#include "Physics.hpp"
#include "ortung/base/Random.hpp"

// Robots of many pieces that overlap cost what they can be worth, not what they ask for.
namespace ortung {
namespace {

constexpr double kCycle = 0.01;

Primitive box(double x, double y, double angle, double size) {
  Primitive shape;
  shape.centre = {x, y};
  shape.angle = angle;
  shape.halfX = shape.halfY = size / 2.0;
  return shape;
}

double secondsOfProcess() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST(Crowd, OfRobotsWithManyPiecesDoesNotHoldUpTheWorld) {
  // 16 robots, each a star of 64 squares, all of which want to the same place.
  Random random(1, 1);
  Physics physics({.cycle = kCycle}, {{-20.0, 20.0, -20.0, 20.0}, {}, {}});
  std::vector<Physics::Body> robots;
  for (int i = 0; i < 16; ++i) {
    std::vector<Primitive> star;
    for (int k = 0; k < 64; ++k)
      star.push_back(box(0.0, 0.0, random.uniform(0.0, 3.0), random.uniform(0.5, 0.52)));
    robots.push_back(physics.add(star, {10.0, Physics::Floor::kDrives},
                                 {0.8 * (i % 4) - 1.2, 0.8 * (i / 4) - 1.2, 0.0}));
  }
  const double before = secondsOfProcess();
  constexpr int kCycles = 100;
  for (int i = 0; i < kCycles; ++i) {
    for (const Physics::Body robot : robots) {
      const Pose2 pose = physics.pose(robot);
      const double to = std::atan2(-pose.y, -pose.x) - pose.theta;
      physics.want(robot, {0.01 * std::cos(to), 0.01 * std::sin(to), 0.0});
    }
    physics.step(kCycle);
  }
  // 3 ms; without the limits of contacts it would not be over within the time of a test.
  RecordProperty("cycle_ms", std::to_string(1e3 * (secondsOfProcess() - before) / kCycles));
  for (const Physics::Body robot : robots) {
    const Pose2 pose = physics.pose(robot);
    EXPECT_LT(std::hypot(pose.x, pose.y), 3.0);
  }
}

TEST(Crowd, PiecesWithinOthersCountOnce) {
  const Primitive whole = box(0.0, 0.0, 0.3, 0.5);
  std::vector<Primitive> pieces(256, whole);
  EXPECT_EQ(withoutHidden(pieces).size(), 1u);
  pieces.push_back(box(0.05, 0.05, 0.3, 0.2));
  Primitive round = box(0.0, 0.0, 0.0, 0.3);
  round.shape = Primitive::Shape::kEllipse;
  pieces.push_back(round);
  EXPECT_EQ(withoutHidden(pieces).size(), 1u);
  // What sticks out somewhere, or behaves otherwise, stays.
  pieces.push_back(box(0.2, 0.0, 0.0, 0.3));
  pieces.push_back(whole);
  pieces.back().zHigh += 0.1;
  pieces.push_back(box(0.05, 0.05, 0.3, 0.2));
  pieces.back().restitution = 0.9;
  EXPECT_EQ(withoutHidden(pieces).size(), 3u);  // the higher one hides all like the first
}

TEST(Crowd, OfTwoDiscsTheOneWithinTheOtherIsHidden) {
  const auto disc = [](double x, double radius) {
    Primitive shape = box(x, 0.0, 0.0, 2.0 * radius);
    shape.shape = Primitive::Shape::kEllipse;
    return shape;
  };
  const auto left = [&](double x, double radius) {  // beside a disc of 0.5 m in the middle
    const std::vector<Primitive> pieces{disc(x, radius), disc(0.0, 0.5)};
    return withoutHidden(pieces);
  };
  for (const auto& [x, radius] :
       {std::pair{0.0, 0.25}, {0.25, 0.125}, {0.25, 0.25}, {-0.25, 0.25}, {0.0, 0.5}}) {
    ASSERT_EQ(left(x, radius).size(), 1u) << x << " " << radius;
    EXPECT_EQ(left(x, radius).front().halfX, 0.5) << x << " " << radius;
  }
  for (const auto& [x, radius] : {std::pair{0.3, 0.25}, {-0.3, 0.25}, {2.0, 0.1}})
    EXPECT_EQ(left(x, radius).size(), 2u) << x << " " << radius;
}

TEST(Crowd, HiddenPiecesWeighNothing) {
  Physics physics({}, {{-5.0, 5.0, -5.0, 5.0}, {}, {}});
  const Primitive whole = box(0.0, 0.0, 0.0, 0.6);
  const std::vector<Primitive> pieces{whole, box(0.2, 0.2, 0.0, 0.1)};
  const auto one = physics.add({&whole, 1}, {10.0, Physics::Floor::kSlides}, {});
  const auto other = physics.add(pieces, {10.0, Physics::Floor::kSlides}, {2.0, 0.0, 0.0});
  EXPECT_NEAR(physics.inertia(one), 10.0 * 0.6 * 0.6 / 6.0, 1e-9);
  EXPECT_EQ(physics.inertia(other), physics.inertia(one));
  EXPECT_EQ(physics.centreOfMass(other).x, 2.0);
}

/// How many contacts a plate has that 100 discs touch at once.
int contactsOfPlate(bool isPlateFirst) {
  constexpr int kDiscs = 100;
  HeightFilter filter;
  b2World world({0.0f, 0.0f});
  world.SetContactFilter(&filter);
  const Heights heights{0.0, 1.0, {}};
  std::vector<Crowd> crowds(kDiscs + 1);
  const auto add = [&](Crowd& crowd, const b2Shape& shape) {
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.userData.pointer = reinterpret_cast<uintptr_t>(&crowd);
    b2Body* body = world.CreateBody(&definition);
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.userData.pointer = reinterpret_cast<uintptr_t>(&heights);
    body->CreateFixture(&fixture);
    return body;
  };
  b2PolygonShape plate;
  plate.SetAsBox(20.0f, 20.0f);
  b2Body* body = isPlateFirst ? add(crowds[0], plate) : nullptr;
  for (std::size_t i = 1; i <= kDiscs; ++i) {
    b2CircleShape disc;
    disc.m_radius = 0.5f;
    disc.m_p = {3.0f * static_cast<float>(i % 10) - 15.0f,
                3.0f * static_cast<float>(i / 10) - 15.0f};  // apart from each other
    add(crowds[i], disc);
  }
  if (!isPlateFirst) body = add(crowds[0], plate);
  filter.count(world);
  world.Step(0.01f, 1, 1);
  int contacts = 0;
  for (const b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next)
    ++contacts;
  return contacts;
}

TEST(Crowd, OneBodyHas64ContactsAtMostWhicheverWasThereFirst) {
  EXPECT_EQ(contactsOfPlate(true), 64);
  EXPECT_EQ(contactsOfPlate(false), 64);
}

TEST(Crowd, ContactsThatAreOverCountForNothing) {
  // More often than a body may have contacts at a time, a crate comes to another one and to a wall,
  // and leaves.
  Physics physics({.cycle = kCycle}, {{-5.0, 5.0, -5.0, 5.0}, {box(3.0, 0.0, 0.0, 1.0)}, {}});
  const Primitive crate = box(0.0, 0.0, 0.0, 0.4);
  const auto body = physics.add({&crate, 1}, {1.0, Physics::Floor::kSlides}, {});
  const auto other = physics.add({&crate, 1}, {1.0, Physics::Floor::kSlides}, {-3.0, 0.0, 0.0});
  for (int i = 0; i < 300; ++i)
    for (const double x : {0.0, 2.295, 0.0, -2.595}) {
      physics.place(body, {x, 0.0, 0.0});
      physics.step(kCycle);
    }
  const auto drive = [&](double speed) {
    physics.place(body, {0.0, 0.0, 0.0}, {speed, 0.0, 0.0});
    for (int i = 0; i < 100; ++i) physics.step(kCycle);
    return physics.pose(body).x;
  };
  EXPECT_LT(drive(10.0), 2.31);
  const double end = drive(-10.0);
  EXPECT_GT(end, physics.pose(other).x + 0.39);
}

}  // namespace
}  // namespace ortung

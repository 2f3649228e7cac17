#include <gtest/gtest.h>

#include <cstddef>
#include <utility>

#include "BlockStock.hpp"

namespace ortung {
namespace {

/// Returns the distance of two objects that an allocator makes one behind the other: the size of
/// its blocks.
std::ptrdiff_t blockOf(int32 size) {
  b2BlockAllocator allocator;
  auto* first = static_cast<std::byte*>(allocator.Allocate(size));
  auto* second = static_cast<std::byte*>(allocator.Allocate(size));
  return second - first;
}

// The engine puts objects of similar sizes into blocks of one size, so ours must have that.
TEST(BlockStock, GivesBlocksOfTheSizesThatTheEngineUses) {
  for (const auto& [size, block] : {std::pair{sizeof(b2Body), 192},
                                    {sizeof(b2Fixture), 96},
                                    {sizeof(b2FixtureProxy), 32},
                                    {sizeof(b2CircleShape), 32},
                                    {sizeof(b2PolygonShape), 160},
                                    {sizeof(b2EdgeShape), 64},
                                    {sizeof(b2FrictionJoint), 256},
                                    {sizeof(b2Contact), 224}}) {
    EXPECT_EQ(blockOf(static_cast<int32>(size)), block) << size;
    EXPECT_EQ((size + 31) / 32 * 32, static_cast<std::size_t>(block)) << size;
  }
}

// Robots that come and go, and kickers that move, take the same memory all the time.
TEST(BlockStock, GivesNoMoreThanThereIsAtATime) {
  BlockStock stock;
  b2World world({0.0f, 0.0f});
  stock.forBody(world);
  const b2BodyDef definition;
  b2Body* ground = world.CreateBody(&definition);
  b2PolygonShape box;
  box.SetAsBox(1.0f, 1.0f);
  b2CircleShape circle;
  circle.m_radius = 1.0f;
  const auto comeAndGo = [&] {
    stock.forBody(world);
    b2Body* body = world.CreateBody(&definition);
    for (const b2Shape* shape :
         {static_cast<const b2Shape*>(&box), static_cast<const b2Shape*>(&circle)}) {
      stock.forFixture(world, *shape);
      body->CreateFixture(shape, 1.0f);
    }
    b2FrictionJointDef joint;
    joint.Initialize(ground, body, {0.0f, 0.0f});
    stock.forJoint(world);
    world.CreateJoint(&joint);
    stock.forContacts(world);
    world.Step(0.01f, 8, 3);
    world.DestroyBody(body);
  };
  comeAndGo();
  const std::size_t first = stock.given();
  EXPECT_GE(first, 2 * sizeof(b2Body) + 2 * sizeof(b2Fixture) + sizeof(b2PolygonShape));
  EXPECT_LT(first, 4096u);
  for (int i = 0; i < 100; ++i) comeAndGo();
  EXPECT_EQ(stock.given(), first);
}

TEST(BlockStock, GivesNothingMoreWhereThereAreMany) {
  BlockStock stock;
  b2World world({0.0f, 0.0f});
  const b2BodyDef definition;
  for (int i = 0; i < 1000; ++i) {
    stock.forBody(world);
    world.CreateBody(&definition);
  }
  EXPECT_LT(stock.given(), 100 * sizeof(b2Body));
}

}  // namespace
}  // namespace ortung

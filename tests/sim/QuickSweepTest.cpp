#include <box2d/b2_time_of_impact.h>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "BoxShapes.hpp"
#include "EngineUnits.hpp"
#include "ortung/base/Random.hpp"

// The look before Box2D's solver against that solver, and against distances at many moments.
namespace ortung {
namespace {

using Sweep = void (*)(b2TOIOutput*, const b2TOIInput*);

/// Box2D's own function, which ours takes the place of.
Sweep solverOfBox2d() {
  void* library = dlopen("libbox2d.so.2", RTLD_LAZY | RTLD_NOLOAD);
  return library == nullptr ? nullptr
                            : reinterpret_cast<Sweep>(
                                  dlsym(library, "_Z14b2TimeOfImpactP11b2TOIOutputPK10b2TOIInput"));
}

/// Boxes, balls, parts of ellipses, triangles and walls as worlds have them.
std::vector<std::unique_ptr<b2Shape>> someShapes() {
  std::vector<std::unique_ptr<b2Shape>> shapes;
  const auto add = [&](Primitive::Shape kind, double halfX, double halfY) {
    Primitive one;
    one.shape = kind;
    one.centre = {0.05, -0.02};
    one.halfX = halfX;
    one.halfY = halfY;
    one.corners = {Point2{-0.2, -0.15}, Point2{0.25, -0.1}, Point2{-0.05, 0.25}};
    for (auto& shape : boxShapesOf(one)) shapes.push_back(std::move(shape));
  };
  add(Primitive::Shape::kRectangle, 0.25, 0.21);
  add(Primitive::Shape::kRectangle, 0.035, 0.055);
  add(Primitive::Shape::kRectangle, 0.0005, 1.0);
  add(Primitive::Shape::kEllipse, 0.11, 0.11);
  add(Primitive::Shape::kEllipse, 0.3, 0.2);
  add(Primitive::Shape::kTriangle, 0.0, 0.0);
  shapes.push_back(boxShapeOf({{-0.5, 0.1}, {0.5, 0.0}, 0.0, 1.0}, {}));
  return shapes;
}

b2Sweep someSweep(Random& random, double apart) {
  const auto draw = [&](double size) { return toEngine(random.uniform(-size, size)); };
  b2Sweep sweep;
  sweep.localCenter = {draw(0.05), draw(0.05)};
  sweep.c0 = {draw(apart), draw(apart)};
  const double way = random.below(2) == 0 ? 0.01 : 0.1;
  sweep.c = sweep.c0 + b2Vec2(draw(way), draw(way));
  sweep.a0 = single(random.uniform(-7.0, 7.0));
  sweep.a = sweep.a0 + single(random.below(3) == 0 ? 0.0 : random.uniform(-0.1, 0.1));
  sweep.alpha0 = 0.0f;
  return sweep;
}

b2TOIInput somePair(const std::vector<std::unique_ptr<b2Shape>>& shapes, Random& random) {
  b2TOIInput input;
  input.proxyA.Set(shapes[random.below(shapes.size())].get(), 0);
  input.proxyB.Set(shapes[random.below(shapes.size())].get(), 0);
  const double apart = random.uniform(0.1, 0.6);  // most pairs touch or nearly do
  input.sweepA = someSweep(random, apart);
  input.sweepB = someSweep(random, apart);
  input.tMax = 1.0f;
  return input;
}

/// Least distance between two shapes without their skins, in the engine's units, at many moments.
float leastDistance(const b2TOIInput& input) {
  constexpr int kMoments = 64;
  float least = 1e9f;
  for (int i = 0; i <= kMoments; ++i) {
    b2DistanceInput at;
    at.proxyA = input.proxyA;
    at.proxyB = input.proxyB;
    input.sweepA.GetTransform(&at.transformA, static_cast<float>(i) / kMoments);
    input.sweepB.GetTransform(&at.transformB, static_cast<float>(i) / kMoments);
    at.useRadii = false;
    b2SimplexCache cache;
    cache.count = 0;
    b2DistanceOutput output;
    b2Distance(&output, &cache, &at);
    least = std::min(least, output.distance);
  }
  return least;
}

TEST(QuickSweep, AnswersAsTheSolverDoes) {
  const Sweep solver = solverOfBox2d();
  ASSERT_NE(solver, nullptr);
  ASSERT_NE(solver, &b2TimeOfImpact) << "Box2D was loaded before libortung_sim";
  const auto shapes = someShapes();
  Random random(17, 1);
  int impacts = 0;
  for (int i = 0; i < 200'000; ++i) {
    const b2TOIInput input = somePair(shapes, random);
    b2TOIOutput ours;
    b2TOIOutput theirs;
    b2TimeOfImpact(&ours, &input);
    solver(&theirs, &input);
    const bool isImpact = theirs.state == b2TOIOutput::e_touching;
    impacts += isImpact ? 1 : 0;
    // Of another answer than an impact the engine knows only that it is none.
    ASSERT_EQ(ours.state == b2TOIOutput::e_touching, isImpact) << i;
    if (isImpact) {
      ASSERT_EQ(ours.t, theirs.t) << i;
    }
  }
  EXPECT_GT(impacts, 10'000);
}

TEST(QuickSweep, FindsApartOnlyWhatIsApartAllTheTime) {
  const auto shapes = someShapes();
  Random random(18, 1);
  int apart = 0;
  for (int i = 0; i < 20'000; ++i) {
    const b2TOIInput input = somePair(shapes, random);
    b2TOIOutput output;
    b2TimeOfImpact(&output, &input);
    if (output.state != b2TOIOutput::e_separated) continue;
    ++apart;
    const float impact = std::max(
        b2_linearSlop, input.proxyA.m_radius + input.proxyB.m_radius - 3.0f * b2_linearSlop);
    ASSERT_GT(leastDistance(input), impact) << i;
  }
  EXPECT_GT(apart, 5'000);
}

}  // namespace
}  // namespace ortung

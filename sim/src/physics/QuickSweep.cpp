// In each step Box2D looks for the time of impact of every two shapes that are near each other,
// with a solver that costs more than all the rest of the step. Nearly always they stay apart, which
// a look at their corners tells: this is Box2D's function with that look before it. The answers are
// the same, bit for bit. The dynamic linker finds it as it does QuietTimer's.
#include <box2d/b2_time_of_impact.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using Sweep = void (*)(b2TOIOutput*, const b2TOIInput*);

constexpr std::size_t kLanes = 4;

/// Corners of a shape at one moment. Beyond the last there are copies of it, up to whole lanes.
struct Corners {
  std::array<float, b2_maxPolygonVertices> x, y;
};

/// A shape's way, seen from a point.
struct Way {
  std::size_t count = 0;  ///< number of corners
  Corners from, to;       ///< corners at both ends
  float bend = 0.0f;      ///< how far a corner's way is from the line between both at most
};

Way wayOf(const b2DistanceProxy& shape, const b2Sweep& sweep, const b2Vec2& origin) {
  Way way;
  way.count = static_cast<std::size_t>(shape.m_count);
  const b2Rot heading(sweep.a0);
  const float turn = sweep.a - sweep.a0;
  const b2Vec2 start = sweep.c0 - origin;
  const b2Vec2 moved = sweep.c - sweep.c0;
  float reach = 0.0f;
  for (std::size_t i = 0; i < way.count || i % kLanes != 0; ++i) {
    const b2Vec2 corner = shape.m_vertices[std::min(i, way.count - 1)];
    const b2Vec2 arm = b2Mul(heading, corner - sweep.localCenter);
    reach = std::max(reach, std::abs(arm.x) + std::abs(arm.y));
    way.from.x[i] = start.x + arm.x;
    way.from.y[i] = start.y + arm.y;
    way.to.x[i] = way.from.x[i] + moved.x - turn * arm.y;
    way.to.y[i] = way.from.y[i] + moved.y + turn * arm.x;
  }
  way.bend = 0.5f * reach * turn * turn;
  return way;
}

/// Returns the least component of some corners along an axis.
float lowest(const Corners& corners, std::size_t count, const b2Vec2& axis) {
  std::array<float, kLanes> least;
  for (std::size_t k = 0; k < kLanes; ++k) least[k] = corners.x[k] * axis.x + corners.y[k] * axis.y;
  if (count > kLanes)
    for (std::size_t k = 0; k < kLanes; ++k)
      least[k] =
          std::min(least[k], corners.x[k + kLanes] * axis.x + corners.y[k + kLanes] * axis.y);
  return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

/// Returns whether there is a distance between two shapes along an axis at both ends. Then there is
/// between them as well: where corners move straight on, the distance along a fixed axis is a
/// concave function of time.
/// @param enough the distance times the length of the axis
bool areApart(const Way& a, const Way& b, const b2Vec2& axis, float enough) {
  return lowest(b.from, b.count, axis) + lowest(a.from, a.count, -axis) > enough &&
         lowest(b.to, b.count, axis) + lowest(a.to, a.count, -axis) > enough;
}

/// Returns whether a face of the first shape separates two shapes.
bool isSplitByFace(const Way& a, const Way& b, float enough) {
  if (a.count < 2) return false;
  std::size_t last = a.count - 1;
  for (std::size_t i = 0; i < a.count; last = i++) {
    const b2Vec2 out(a.from.y[i] - a.from.y[last], a.from.x[last] - a.from.x[i]);
    const float gap = lowest(b.from, b.count, out) - out.x * a.from.x[i] - out.y * a.from.y[i];
    if (gap <= 0.0f) continue;
    const float needed = enough * out.Length();
    if (gap > needed && areApart(a, b, out, needed)) return true;
  }
  return false;
}

b2Vec2 middleOf(const Way& way) {
  const std::size_t opposite = way.count / 2;
  return {0.5f * (way.from.x[0] + way.from.x[opposite]),
          0.5f * (way.from.y[0] + way.from.y[opposite])};
}

/// Returns whether two shapes certainly do not come as near as an impact is.
bool stayApart(const b2TOIInput& input) {
  const b2Vec2 origin = input.sweepA.c0;
  const Way a = wayOf(input.proxyA, input.sweepA, origin);
  const Way b = wayOf(input.proxyB, input.sweepB, origin);
  // Box2D takes as an impact what is within its slop of this distance, and it rounds positions.
  const float impact =
      std::max(b2_linearSlop, input.proxyA.m_radius + input.proxyB.m_radius - 3.0f * b2_linearSlop);
  const float rounding = 1e-6f * (std::abs(origin.x) + std::abs(origin.y));
  const float enough = impact + 0.5f * b2_linearSlop + rounding + a.bend + b.bend;
  const b2Vec2 apart = middleOf(b) - middleOf(a);
  return areApart(a, b, apart, enough * apart.Length()) || isSplitByFace(a, b, enough) ||
         isSplitByFace(b, a, enough);
}

}  // namespace

void b2TimeOfImpact(b2TOIOutput* output, const b2TOIInput* input) {
  static const auto solver =
      reinterpret_cast<Sweep>(dlsym(RTLD_NEXT, "_Z14b2TimeOfImpactP11b2TOIOutputPK10b2TOIInput"));
  if (!stayApart(*input)) return solver(output, input);
  output->state = b2TOIOutput::e_separated;
  output->t = input->tMax;
}

#pragma once

#include <box2d/box2d.h>

#include "ortung/base/Pose2.hpp"
#include "ortung/sim/Primitive.hpp"

namespace ortung {

/// The engine is tuned for bodies of metres: it lets them overlap by up to 15 mm, welds corners
/// that are nearer than 2.5 mm and gives polygons a skin of 10 mm. Its metre is an eighth of ours,
/// which makes these 1.9, 0.3 and 1.25 mm. (A power of two: nothing is rounded.)
inline constexpr double kScale = 8.0;  ///< engine units per metre

inline float single(double value) { return static_cast<float>(value); }
inline float toEngine(double metres) { return single(kScale * metres); }
inline b2Vec2 toEngine(const Point2& p) { return {toEngine(p.x), toEngine(p.y)}; }
inline double toMetres(float length) { return static_cast<double>(length) / kScale; }

}  // namespace ortung

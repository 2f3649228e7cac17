#include <algorithm>
#include <cmath>

#include "BoxShapes.hpp"
#include "Engine.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kSlack = 0.003;       ///< overlap that bodies in contact may have [m]
constexpr int kDirections = 16;        ///< number of directions in which a way out is searched
constexpr double kNearest = 0.005;     ///< shortest way out that is tried [m]
constexpr double kFarthest = 0.6;      ///< longest way out that is tried [m]
constexpr double kPrecision = 0.0005;  ///< precision of a way out [m]
/// Distance of a thing's flanks from its middle, as a share of its reach.
constexpr double kFlank = 0.6;
/// Number of things that one change of shape pushes away at most.
constexpr std::size_t kMostPushed = 8;
constexpr int kRest = 10;  ///< changes of shape without pushing after one that failed

}  // namespace

Physics::Engine::Item& Physics::Engine::itemOf(const b2Body* body) {
  return *std::find_if(items.begin(), items.end(),
                       [&](const Item& item) { return item.body == body; });
}

/// Returns whether a body would touch nothing at a place.
bool Physics::Engine::isFree(const b2Body& body, const b2Transform& at) const {
  for (const b2Fixture* f = body.GetFixtureList(); f != nullptr; f = f->GetNext()) {
    Touching touching(*f->GetShape(), heightsOf(*f), at, &body);
    if (touching.lookIn(world)) return false;
  }
  return true;
}

/// Finds the bodies in the way of pieces that a body is to get. @returns false if one of them can't
/// be pushed, or if there are too many
bool Physics::Engine::findObstacles(const Item& item, std::span<const Primitive> added,
                                    std::vector<Item*>& found) {
  std::vector<b2Body*> bodies;
  for (const Primitive& piece : added) {
    const Heights heights{piece.zLow, piece.zHigh, {}};
    for (const auto& shape : boxShapesOf(drawnIn(piece, kSlack))) {
      Touching touching(*shape, heights, item.body->GetTransform(), item.body, false);
      touching.lookIn(world);
      bodies.insert(bodies.end(), touching.found().begin(), touching.found().end());
    }
  }
  for (const b2Body* body : bodies) {
    if (body->GetType() != b2_dynamicBody) return false;
    Item& other = itemOf(body);
    if (other.properties.floor == Floor::kDrives) return false;
    if (std::find(found.begin(), found.end(), &other) == found.end()) found.push_back(&other);
  }
  return found.size() <= kMostPushed;
}

/// Returns whether a way is free: neither a thing's middle nor its flanks meet anything on it.
bool Physics::Engine::isOpen(const Item& thing, const b2Vec2& way, const Fresh& fresh) const {
  const b2Vec2 across = (toEngine(kFlank * thing.reach) / way.Length()) * b2Vec2(-way.y, way.x);
  Barrier barrier(*thing.heights.front(), thing.body, fresh);
  for (const float side : {0.0f, 1.0f, -1.0f}) {
    const b2Vec2 from = thing.body->GetWorldCenter() + side * across;
    world.RayCast(&barrier, from, from + way);
  }
  return !barrier.isFound();
}

/// Returns the shortest free way to a place where a thing touches nothing.
std::optional<b2Vec2> Physics::Engine::wayOut(const Item& thing, const Item& from,
                                              const Fresh& fresh) const {
  const b2Vec2 here = thing.body->GetPosition();
  const b2Vec2 apart = here - from.body->GetPosition();
  const double ahead = std::atan2(static_cast<double>(apart.y), static_cast<double>(apart.x));
  const auto wayOf = [&](double angle, double length) {
    return toEngine(Point2{length * std::cos(angle), length * std::sin(angle)});
  };
  const auto isFreeAt = [&](const b2Vec2& way) {
    return isFree(*thing.body, b2Transform(here + way, thing.body->GetTransform().q));
  };
  double nearer = 0.0;
  for (double length = kNearest; length < kFarthest; length += std::max(kNearest, 0.1 * length)) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = ahead + kTurn * i / kDirections;
      if (!isFreeAt(wayOf(angle, length))) continue;
      double low = nearer;
      double high = length;
      while (high - low > kPrecision) {
        const double half = 0.5 * (low + high);
        (isFreeAt(wayOf(angle, half)) ? high : low) = half;
      }
      if (isOpen(thing, wayOf(angle, high), fresh)) return wayOf(angle, high);
    }
    nearer = length;
  }
  return std::nullopt;
}

/// Moves all things out of a body, or none if one of them has no way out.
bool Physics::Engine::pushOut(const Item& item, const Fresh& fresh, std::span<Item* const> things) {
  std::vector<b2Vec2> places;
  bool haveRoom = true;
  for (Item* thing : things) {
    const auto way = wayOut(*thing, item, fresh);
    haveRoom = way.has_value();
    if (!haveRoom) break;
    places.push_back(thing->body->GetPosition());
    thing->body->SetTransform(places.back() + *way, thing->body->GetAngle());
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    Item& thing = *things[i];
    if (!haveRoom) {
      thing.body->SetTransform(places[i], thing.body->GetAngle());
      continue;
    }
    const b2Vec2 moved = thing.body->GetPosition() - places[i];
    thing.pose.x += toMetres(moved.x);
    thing.pose.y += toMetres(moved.y);
    thing.planned = thing.pose;
  }
  return haveRoom;
}

bool Physics::reshape(Body body, std::span<const Primitive> pieces,
                      std::span<const Primitive> added) {
  engine_->wake();
  Engine::Item& item = engine_->items[body];
  std::vector<Engine::Item*> inTheWay;
  if (!engine_->findObstacles(item, added, inTheWay)) return false;
  if (!inTheWay.empty() && --item.rest > 0) return false;
  std::vector<b2Fixture*> old;
  for (b2Fixture* f = item.body->GetFixtureList(); f != nullptr; f = f->GetNext()) old.push_back(f);
  std::vector<std::unique_ptr<Heights>> heights;
  const std::vector<Primitive> shape = withoutHidden(pieces);
  engine_->attach(item.body, shape, heights);
  if (!inTheWay.empty() && !engine_->pushOut(item, heights, inTheWay)) {
    for (b2Fixture* f = item.body->GetFixtureList(); f != old.front();) {
      b2Fixture* next = f->GetNext();
      item.body->DestroyFixture(f);
      f = next;
    }
    item.rest = kRest;
    return false;
  }
  for (b2Fixture* f : old) item.body->DestroyFixture(f);
  item.heights = std::move(heights);
  engine_->weigh(item, shape);
  return true;
}

}  // namespace ortung

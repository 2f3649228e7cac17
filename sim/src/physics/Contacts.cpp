#include "Contacts.hpp"

#include <algorithm>
#include <cmath>

#include "EngineUnits.hpp"

namespace ortung {
namespace {

// Greatest numbers of contacts of one body. Robots of ten pieces that push each other have about
// ten, with maps there are dozens.
constexpr int kMostWithMoving = 64;
constexpr int kMostWithGround = 256;

/// Way that bodies may still approach each other in a step without being swept [m].
constexpr double kSink = 0.0005;

Crowd* crowdOf(b2Body* body) { return reinterpret_cast<Crowd*>(body->GetUserData().pointer); }

float lengthOf(const b2Fixture& fixture) {
  const b2AABB& box = fixture.GetAABB(0);
  return (box.upperBound - box.lowerBound).Length();
}

/// Returns a bound of the velocity at which two bodies that touch approach each other.
float approachOf(const b2Contact& contact) {
  const b2Fixture& first = *contact.GetFixtureA();
  const b2Fixture& second = *contact.GetFixtureB();
  const b2Body& a = *first.GetBody();
  const b2Body& b = *second.GetBody();
  b2WorldManifold manifold;
  contact.GetWorldManifold(&manifold);
  const int points = contact.GetManifold()->pointCount;
  float approach = 0.0f;
  for (int i = 0; i < points; ++i) {
    const b2Vec2& point = manifold.points[i];
    approach =
        std::max(approach, b2Dot(manifold.normal, a.GetLinearVelocityFromWorldPoint(point) -
                                                      b.GetLinearVelocityFromWorldPoint(point)));
  }
  // Two shapes with corners may turn around the point where they touch, until another one does.
  if (points == 1 && first.GetType() != b2Shape::e_circle && second.GetType() != b2Shape::e_circle)
    approach += std::abs(a.GetAngularVelocity() - b.GetAngularVelocity()) *
                std::min(lengthOf(first), lengthOf(second));
  return approach;
}

}  // namespace

bool overlap(const Heights& a, const Heights& b) { return a.low < b.high && b.low < a.high; }

const Heights& heightsOf(const b2Fixture& fixture) {
  return *reinterpret_cast<const Heights*>(const_cast<b2Fixture&>(fixture).GetUserData().pointer);
}

void HeightFilter::count(b2World& world) {
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
    if (Crowd* crowd = crowdOf(body)) *crowd = {};
  for (b2Contact* contact = world.GetContactList(); contact; contact = contact->GetNext()) {
    Crowd* a = crowdOf(contact->GetFixtureA()->GetBody());
    Crowd* b = crowdOf(contact->GetFixtureB()->GetBody());
    if (a != nullptr) ++(b == nullptr ? a->withGround : a->withMoving);
    if (b != nullptr) ++(a == nullptr ? b->withGround : b->withMoving);
  }
}

bool HeightFilter::ShouldCollide(b2Fixture* a, b2Fixture* b) {
  if (!overlap(heightsOf(*a), heightsOf(*b))) return false;
  Crowd* first = crowdOf(a->GetBody());
  Crowd* second = crowdOf(b->GetBody());
  if (first != nullptr && second != nullptr) {
    if (std::max(first->withMoving, second->withMoving) >= kMostWithMoving) return false;
    ++first->withMoving;
    ++second->withMoving;
    return true;
  }
  Crowd* moving = first != nullptr ? first : second;
  if (moving == nullptr || moving->withGround >= kMostWithGround) return false;
  ++moving->withGround;
  return true;
}

void Bouncing::BeginContact(b2Contact* contact) {
  const auto& a = heightsOf(*contact->GetFixtureA()).restitution;
  const auto& b = heightsOf(*contact->GetFixtureB()).restitution;
  if (!a && !b) return;
  contact->SetRestitution(
      static_cast<float>(a && b ? std::min(*a, *b) : a.value_or(b.value_or(0.0))));
}

void Bouncing::PostSolve(b2Contact* contact, const b2ContactImpulse* /*impulse*/) {
  // The engine enables it again in its next step.
  if (!sweepsAll_ && toMetres(approachOf(*contact)) * dt_ < kSink) contact->SetEnabled(false);
}

Touching::Touching(const b2Shape& shape, const Heights& heights, const b2Transform& place,
                   const b2Body* self, bool isOneEnough)
    : shape_(shape), heights_(heights), place_(place), self_(self), isOneEnough_(isOneEnough) {}

bool Touching::ReportFixture(b2Fixture* fixture) {
  b2Body* body = fixture->GetBody();
  if (body == self_ || !overlap(heights_, heightsOf(*fixture))) return true;
  if (std::find(found_.begin(), found_.end(), body) != found_.end()) return true;
  const int32 children = fixture->GetShape()->GetChildCount();
  for (int32 child = 0; child < children; ++child) {
    if (!b2TestOverlap(fixture->GetShape(), child, &shape_, 0, body->GetTransform(), place_))
      continue;
    found_.push_back(body);
    return !isOneEnough_;
  }
  return true;
}

bool Touching::lookIn(const b2World& world) {
  b2AABB box;
  shape_.ComputeAABB(&box, place_, 0);
  world.QueryAABB(this, box);
  return !found_.empty();
}

float Barrier::ReportFixture(b2Fixture* fixture, const b2Vec2& /*point*/, const b2Vec2& /*normal*/,
                             float /*fraction*/) {
  const Heights& heights = heightsOf(*fixture);
  const bool isFresh = std::any_of(fresh_.begin(), fresh_.end(),
                                   [&](const auto& one) { return one.get() == &heights; });
  if (fixture->GetBody() == self_ || isFresh || !overlap(heights_, heights)) return -1.0f;
  found_ = true;
  return 0.0f;
}

}  // namespace ortung

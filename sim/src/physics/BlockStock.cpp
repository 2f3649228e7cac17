#include "BlockStock.hpp"

#include <algorithm>

namespace ortung {
namespace {

constexpr int32 kMany = 64;          ///< number of objects from which the engine's way is used
constexpr int32 kNewContacts = 4;    ///< contacts that a step is likely to make at most
constexpr int32 kStep = 32;          ///< block sizes of the engine are multiples of this
constexpr std::size_t kSlab = 1024;  ///< size of the pieces of memory that are cut [bytes]

/// Number of fixtures of each kind of shape.
struct Census {
  int32 all = 0, circles = 0, polygons = 0, edges = 0;
};

Census censusOf(const b2World& world) {
  Census census;
  for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
    for (const b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext()) {
      ++census.all;
      if (f->GetType() == b2Shape::e_circle) ++census.circles;
      if (f->GetType() == b2Shape::e_polygon) ++census.polygons;
      if (f->GetType() == b2Shape::e_edge) ++census.edges;
    }
  return census;
}

}  // namespace

void BlockStock::forBody(const b2World& world) { fill(world, bodies_, world.GetBodyCount() + 1); }

void BlockStock::forFixture(const b2World& world, const b2Shape& shape) {
  if (world.GetProxyCount() >= kMany) return;
  Census census = censusOf(world);
  ++census.all;
  if (shape.GetType() == b2Shape::e_circle) ++census.circles;
  if (shape.GetType() == b2Shape::e_polygon) ++census.polygons;
  if (shape.GetType() == b2Shape::e_edge) ++census.edges;
  fill(world, fixtures_, census.all);
  fill(world, proxies_, census.all + census.circles);
  fill(world, polygons_, census.polygons);
  fill(world, edges_, census.edges);
}

void BlockStock::forJoint(const b2World& world) { fill(world, joints_, world.GetJointCount() + 1); }

void BlockStock::forContacts(const b2World& world) {
  fill(world, contacts_, world.GetContactCount() + kNewContacts);
}

/// Gives blocks until there were as many as are needed at a time. Those of objects that have ended
/// are with the engine still.
void BlockStock::fill(const b2World& world, Shelf& shelf, int32 needed) {
  needed = std::min(needed, kMany);
  for (; shelf.given < needed; ++shelf.given) {
    const int32 size = (shelf.size + kStep - 1) / kStep * kStep;
    world.GetContactManager().m_allocator->Free(cut(static_cast<std::size_t>(size)), size);
  }
}

std::byte* BlockStock::cut(std::size_t size) {
  if (rest_.size() < size) {
    slabs_.push_back(std::make_unique_for_overwrite<std::byte[]>(kSlab));
    rest_ = {slabs_.back().get(), kSlab};
  }
  std::byte* block = rest_.data();
  rest_ = rest_.subspan(size);
  given_ += size;
  return block;
}

}  // namespace ortung

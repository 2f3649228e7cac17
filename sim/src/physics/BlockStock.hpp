#pragma once

#include <box2d/box2d.h>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace ortung {

/// Memory for the small objects of an engine's world. By itself the engine takes 16 kB for each
/// size of object as soon as there is one, so a world of three bodies has 100 kB, scattered over
/// six places. Whoever lets the engine make something asks the stock before, which gives the engine
/// blocks that it finds first. In worlds of more objects the engine's way wastes nothing, and the
/// stock gives nothing. What the engine computes does not depend on it. Not thread-safe.
class BlockStock {
 public:
  BlockStock() = default;
  BlockStock(const BlockStock&) = delete;
  BlockStock& operator=(const BlockStock&) = delete;

  /// Gives blocks for another body, for a fixture of a shape, for a joint that holds a body to the
  /// floor, or for the contacts that the engine's next step is likely to make.
  /// @param world must end before the stock does
  void forBody(const b2World& world);
  void forFixture(const b2World& world, const b2Shape& shape);
  void forJoint(const b2World& world);
  void forContacts(const b2World& world);

  /// Returns the number of bytes that were given.
  std::size_t given() const { return given_; }

 private:
  /// Blocks of one size.
  struct Shelf {
    int32 size = 0;   ///< size of a block [bytes]
    int32 given = 0;  ///< number of blocks that were given
  };

  void fill(const b2World& world, Shelf& shelf, int32 needed);
  std::byte* cut(std::size_t size);

  Shelf bodies_{sizeof(b2Body)};
  Shelf fixtures_{sizeof(b2Fixture)};
  Shelf proxies_{sizeof(b2FixtureProxy)};  ///< circles have blocks of the same size
  Shelf polygons_{sizeof(b2PolygonShape)};
  Shelf edges_{sizeof(b2EdgeShape)};
  Shelf joints_{sizeof(b2FrictionJoint)};
  Shelf contacts_{sizeof(b2Contact)};
  std::vector<std::unique_ptr<std::byte[]>> slabs_;
  std::span<std::byte> rest_;  ///< what is left of the last slab
  std::size_t given_ = 0;
};

}  // namespace ortung

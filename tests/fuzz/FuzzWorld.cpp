// A world file. Maps that it may name: map.yaml, with an image. Every 16th of those that are taken
// gets its rays' geometry, too, which takes a thousand times as long.
#include <cmath>

#include "Fuzz.hpp"
#include "WorldModel.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace {

using namespace ortung;

bool writeMaps() {
  fuzz::write("map.yaml", "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  fuzz::write("map.pgm", "P5 3 2 255\n" + std::string("\xfe\0\xcd\xfe\xfe\0", 6));
  return true;
}

void use(const SimWorld& world, const Box2& bounds) {
  std::vector<float> ranges(16);
  const double x = 0.5 * (bounds.xLow + bounds.xHigh) + 0.01;
  const double y = 0.5 * (bounds.yLow + bounds.yHigh) + 0.01;
  world.castFan({.x = x,
                 .y = y,
                 .z = 0.2,
                 .firstAngle = 0.0,
                 .angleStep = 0.4,
                 .elevation = 0.1,
                 .maxRange = 20.0},
                0, ranges);
  for (const float range : ranges) fuzz::require(range >= 0.0F && range <= 20.0F);
  world.isFree(x, y, {0.2});
  world.isVisible(bounds.xLow, bounds.yLow, 0.1, x, y, 0.3, 0, 0.01);
  const double width = std::max(bounds.xHigh - bounds.xLow, bounds.yHigh - bounds.yLow);
  const FieldRegion region = world.region(std::max(width / 30.0, 0.001), {0.1});
  fuzz::require(region.open.size() == region.grid.size());
  fuzz::require(!world.fingerprint().empty());
  world.solids();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const bool kIsReady = writeMaps();
  fuzz::require(kIsReady);
  const auto file = fuzz::write("world.toml", {reinterpret_cast<const char*>(bytes), size});
  fuzz::refusedOrDone<ConfigError>([&] {
    const WorldModel model = readWorldModel(file);
    fuzz::require(fingerprintOf(model).size() == 16);
    static unsigned taken = 0;
    if (++taken % 16 == 0) use(*readWorld(file), model.bounds);
  });
  return 0;
}

// Nothing in a file may crash the reader: it loads, or it is refused with a ConfigError.
#include <gtest/gtest.h>

#include "../damage/SmallPngs.hpp"
#include "CarmenBytes.hpp"
#include "WorldFiles.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::test {
namespace {

std::string mutated(std::string bytes, Random& random) {
  const std::uint64_t changes = 1 + random.below(4);
  for (std::uint64_t i = 0; i < changes && !bytes.empty(); ++i) {
    const auto at = static_cast<std::size_t>(random.below(bytes.size()));
    const auto length = static_cast<std::size_t>(1 + random.below(8));
    switch (random.below(5)) {
      case 0:
        bytes[at] = static_cast<char>(random.next());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at,
                     bytes.substr(static_cast<std::size_t>(random.below(bytes.size())), length));
        break;
      default:
        bytes.resize(at);
        break;
    }
  }
  return bytes;
}

/// Loads a world and uses it a little. Returns whether it was accepted.
bool survives(const std::filesystem::path& file) {
  try {
    const auto world = readWorld(file);
    std::vector<float> ranges(20);
    world->castFan({.x = 0.1,
                    .y = 0.1,
                    .z = 0.2,
                    .firstAngle = 0,
                    .angleStep = 0.3,
                    .elevation = 0,
                    .maxRange = 8},
                   0, ranges);
    for (const float range : ranges) EXPECT_TRUE(range >= 0 && range <= 8);
    world->isFree(0.1, 0.1, {0.2});
    return true;
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()), "");
    return false;
  }
}

/// Mutates one file of a world many times.
void mutate(const TemporaryFolder& folder, const std::string& victim, const std::string& content,
            std::uint64_t seed, int rounds) {
  Random random(seed);
  int accepted = 0;
  for (int i = 0; i < rounds; ++i) {
    folder.write(victim, mutated(content, random));
    accepted += survives(folder.path() / "world.toml") ? 1 : 0;
  }
  folder.write(victim, content);
  EXPECT_TRUE(survives(folder.path() / "world.toml"));
  EXPECT_LT(accepted, rounds);
}

const std::string kWorld = R"([world]
name = "small"
x_m = [-3, 3]
[[rectangle]]
kind = "wall"
center_m = [1, 0.5]
size_m = [1.2, 0.4]
angle_deg = 25
z_m = [0, 0.5]
[[ellipse]]
kind = "post"
identity = 1
center_m = [-1, -0.5]
size_m = [1.4, 0.6]
[[ellipse]]
kind = "line"
center_m = [0, 0]
size_m = [1, 1]
stroke_m = 0.05
arc_deg = [0, 90]
[[triangle]]
corners_m = [1, -1.5, 2.2, -1.2, 1.6, -0.4]
[[landmark]]
kind = "tag"
identity = 2
position_m = [1, 1, 0.5]
)";

TEST(Mutations, OfAWorldFileNeverCrash) {
  const TemporaryFolder folder;
  mutate(folder, "world.toml", kWorld, 1, 1500);
}

TEST(Mutations, OfAMapYamlNeverCrash) {
  const TemporaryFolder folder;
  folder.write("world.toml", gridWorld());
  folder.write("map.pgm", pgmOf({"..#", ".#.", "...", "#  "}));
  mutate(folder, "map.yaml", mapYaml(), 2, 1500);
}

TEST(Mutations, OfAPgmNeverCrash) {
  const TemporaryFolder folder;
  folder.write("world.toml", gridWorld());
  folder.write("map.yaml", mapYaml());
  mutate(folder, "map.pgm", pgmOf({"..#", ".#.", "...", "#  "}), 3, 1500);
}

TEST(Mutations, OfAPngNeverCrash) {
  const std::string png = fromHex(kGrey);
  const TemporaryFolder folder;
  folder.write("world.toml", gridWorld());
  folder.write("map.yaml", mapYaml());
  mutate(folder, "map.pgm", png, 4, 1500);
}

TEST(Mutations, OfACarmenMapNeverCrash) {
  const TemporaryFolder folder;
  folder.write("world.toml", gridWorld("a.map"));
  mutate(folder, "a.map", carmenMap(3, 2, 0.5f, {0, 1, 0.1f, -1, 0.5f, 0.2f}), 5, 1500);
}

}  // namespace
}  // namespace ortung::test

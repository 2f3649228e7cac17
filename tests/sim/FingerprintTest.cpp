#include <gtest/gtest.h>

#include <set>

#include "WorldFiles.hpp"

namespace ortung::test {
namespace {

const std::string kBox = "[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [1, 2]\nangle_deg = 10\n";
const std::string kPost =
    "[[ellipse]]\nkind = \"post\"\nidentity = 1\ncenter_m = [5, 0]\nsize_m = [0.2, 0.2]\n";
const std::string kBounds = "[world]\nx_m = [-9, 9]\ny_m = [-9, 9]\n";

std::string fingerprintOf(const std::string& toml) { return worldOf(toml)->fingerprint(); }

std::string fingerprintOfGrid(const std::string& pgm, const std::string& yaml,
                              const std::string& more = "") {
  const TemporaryFolder folder;
  folder.write("map.pgm", pgm);
  folder.write("map.yaml", yaml);
  return readWorld(folder.write("world.toml", gridWorld("map.yaml", more)))->fingerprint();
}

TEST(Fingerprint, IsSixteenHexadecimalDigits) {
  const std::string print = fingerprintOf(kBounds + kBox);
  EXPECT_EQ(print.size(), 16u);
  EXPECT_EQ(print.find_first_not_of("0123456789abcdef"), std::string::npos);
}

// Tables that were learned long ago must still be known by it.
TEST(Fingerprint, StaysTheSameFromReleaseToRelease) {
  EXPECT_EQ(fingerprintOf(kBounds + kBox + kPost), "00f315bae1fde647");
}

TEST(Fingerprint, DoesNotDependOnNamesCommentsOrder) {
  const std::string print = fingerprintOf(kBounds + kBox + kPost);
  EXPECT_EQ(fingerprintOf(kBounds + kPost + kBox), print);
  EXPECT_EQ(fingerprintOf("# a remark\n" + kBounds + "name = \"other\"\n" + kBox +
                          "name = \"box\"\n" + kPost),
            print);
}

TEST(Fingerprint, ChangesWithEverythingThatShapesWhatSensorsSee) {
  std::set<std::string> prints{
      fingerprintOf(kBounds + kBox),
      fingerprintOf(kBox),  // other bounds
      fingerprintOf(kBounds + kBox + kPost),
      fingerprintOf(kBounds + kBox + "z_m = [0, 0.5]\n"),
      fingerprintOf(kBounds + kBox + "kind = \"wall\"\n"),
      fingerprintOf(kBounds + kBox + "colour = \"blue\"\n"),
      fingerprintOf(kBounds + kBox + "identity = 3\n"),
      fingerprintOf(kBounds +
                    "[[rectangle]]\ncenter_m = [3, 0.001]\nsize_m = [1, 2]\nangle_deg = 10\n"),
      fingerprintOf(kBounds +
                    "[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [1, 2.001]\nangle_deg = 10\n"),
      fingerprintOf(kBounds +
                    "[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [1, 2]\nangle_deg = 10.1\n"),
      fingerprintOf(kBounds + kBox +
                    "[[landmark]]\nkind = \"tag\"\nidentity = 1\nposition_m = [1, 1]\n"),
      fingerprintOf(kBounds + kBox +
                    "[[landmark]]\nkind = \"tag\"\nidentity = 2\nposition_m = [1, 1]\n"),
      fingerprintOf(kBounds + "[[ellipse]]\ncenter_m = [3, 0]\nsize_m = [1, 2]\nangle_deg = 10\n")};
  EXPECT_EQ(prints.size(), 13u);
}

TEST(Fingerprint, OfAGridIsThatOfItsCellsAndPlace) {
  const std::string map = pgmOf({"..#", ".. "});
  const std::string print = fingerprintOfGrid(map, mapYaml());
  EXPECT_EQ(fingerprintOfGrid(map, mapYaml() + "# a remark\n"), print);
  EXPECT_NE(fingerprintOfGrid(pgmOf({"..#", ".#."}), mapYaml()), print);
  EXPECT_NE(fingerprintOfGrid(map, mapYaml("map.pgm", "[0, 1, 0]")), print);
  EXPECT_NE(fingerprintOfGrid(map, mapYaml("map.pgm", "[0, 0, 0]", "0.4")), print);
  EXPECT_NE(fingerprintOfGrid(map, mapYaml(), "z_m = [0, 0.5]\n"), print);
  EXPECT_NE(fingerprintOfGrid(map, mapYaml(), "unknown_margin_m = 0\n"), print);
  const auto atDepth = [&](const std::string& cells) {
    return fingerprintOfGrid(map, mapYaml(), "surface_depth_cells = " + cells + "\n");
  };
  EXPECT_NE(atDepth("0.5"), print);
  EXPECT_NE(atDepth("0.5"), atDepth("0.25"));
  EXPECT_EQ(atDepth("0"), print);
  const auto withError = [&](const std::string& metres) {
    return fingerprintOfGrid(map, mapYaml(), "map_error_m = " + metres + "\n");
  };
  EXPECT_NE(withError("0.5"), print);
  EXPECT_NE(withError("0.5"), atDepth("0.5"));
  EXPECT_NE(withError("0.5"), withError("0.25"));
  EXPECT_EQ(withError("0"), print);
}

}  // namespace
}  // namespace ortung::test

// Every kind of mistake in a world file, with the message that must let its author repair it.
#include <gtest/gtest.h>

#include "WorldFiles.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::test {
namespace {

#define EXPECT_REFUSED(toml, part)                                                                \
  do {                                                                                            \
    const std::string message = refusalOf(std::string(toml));                                     \
    EXPECT_NE(message.find(part), std::string::npos) << (message.empty() ? "accepted" : message); \
    EXPECT_NE(message.find("world.toml"), std::string::npos) << message;                          \
  } while (false)

const std::string kBox = "[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [1, 2]\n";

TEST(BadWorld, FilesThatAreMissingOrNoToml) {
  EXPECT_NE(refusalOf(std::filesystem::path("/nowhere/world.toml")).find("/nowhere/world.toml"),
            std::string::npos);
  EXPECT_REFUSED("[[rectangle", "");
  EXPECT_REFUSED("", "the world is empty");
}

TEST(BadWorld, UnknownKeys) {
  EXPECT_REFUSED(kBox + "colur = \"red\"\n", "colur");
  EXPECT_REFUSED(kBox + "[[circle]]\nradius_m = 1\n", "circle");
  EXPECT_REFUSED(kBox + "[world]\nsize_m = [1, 2]\n", "size_m");
  EXPECT_REFUSED(kBox + "stroke_m = 0.1\n", "stroke_m");  // rectangles have none
  EXPECT_REFUSED("[[ellipse]]\ncenter_m = [3, 0]\nsize_m = [1, 2]\nstroke_m = 0.1\n", "stroke_m");
}

TEST(BadWorld, AMisspeltShapeIsNamedThoughNothingElseIsThere) {
  const std::string refusal = refusalOf(
      std::string("[world]\nx_m = [0, 9]\n\n[[rectangel]]\ncenter_m = [0, 0]\nsize_m = [1, 1]\n"));
  EXPECT_NE(refusal.find("world.toml:4: rectangel is not known here"), std::string::npos)
      << refusal;
  EXPECT_NE(refusal.find("rectangle"), std::string::npos);
  EXPECT_REFUSED("[world]\nx_m = [0, 9]\n", "the world is empty");
}

TEST(BadWorld, AsManyPrimitivesAsAreTakenFitIntoAFile) {
  std::string text;
  for (int i = 0; i < 65536; ++i)
    text += "[[rectangle]]\nkind = \"line\"\ncenter_m = [" + std::to_string(i % 256) + ", " +
            std::to_string(i / 256) + "]\nsize_m = [0.5, 0.25]\n";
  EXPECT_EQ(refusalOf(text), "");
  EXPECT_REFUSED(text + "[[rectangle]]\ncenter_m = [0, 0]\nsize_m = [1, 1]\n", "65536");
}

TEST(BadWorld, KeysWithoutOrWithWrongUnit) {
  EXPECT_REFUSED("[[rectangle]]\ncenter = [3, 0]\nsize_m = [1, 2]\n", "center_m");
  EXPECT_REFUSED(kBox + "angle_rad = 1\n", "angle_rad");
}

TEST(BadWorld, WrongKindsOfValues) {
  EXPECT_REFUSED("[[rectangle]]\ncenter_m = 3\nsize_m = [1, 2]\n", "center_m");
  EXPECT_REFUSED("[[rectangle]]\ncenter_m = [3]\nsize_m = [1, 2]\n", "center_m");
  EXPECT_REFUSED("[[rectangle]]\ncenter_m = [\"a\", 1]\nsize_m = [1, 2]\n", "center_m");
  EXPECT_REFUSED("rectangle = 3\n", "rectangle");
  EXPECT_REFUSED(kBox + "kind = 3\n", "kind");
  EXPECT_REFUSED(kBox + "identity = 1.5\n", "identity");
}

TEST(BadWorld, NumbersOutOfRange) {
  EXPECT_REFUSED("[[rectangle]]\ncenter_m = [20000, 0]\nsize_m = [1, 2]\n", "center_m");
  EXPECT_REFUSED("[[rectangle]]\ncenter_m = [nan, 0]\nsize_m = [1, 2]\n", "center_m");
  EXPECT_REFUSED("[[rectangle]]\ncenter_m = [inf, 0]\nsize_m = [1, 2]\n", "center_m");
  EXPECT_REFUSED("[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [0, 2]\n", "size_m");
  EXPECT_REFUSED("[[ellipse]]\ncenter_m = [3, 0]\nsize_m = [1, -2]\n", "size_m");
  EXPECT_REFUSED("[[triangle]]\ncorners_m = [0, 0, 1, 1, 2, 2]\n", "on one line");
  EXPECT_REFUSED("[[triangle]]\ncorners_m = [0, 0, 1, 0, 0.5, 0.0009]\n",
                 "of a triangle 0.000900 m high");
  EXPECT_EQ(refusalOf(kBox + "[[triangle]]\ncorners_m = [0, 0, 1, 0, 0.5, 0.001]\n"), "");
  EXPECT_REFUSED("[[triangle]]\ncorners_m = [0, 0, 1, 1]\n", "corners_m");
  EXPECT_REFUSED(kBox + "z_m = [1, 1]\n", "high at least");
  EXPECT_REFUSED(kBox + "z_m = [0, 1e9]\n", "z_m");
  EXPECT_REFUSED(kBox + "identity = -1\n", "identity");
  EXPECT_REFUSED(kBox + "identity = 5000000000\n", "identity");
  EXPECT_REFUSED(kBox + "[world]\nx_m = [1, -1]\n", "low below high");
}

TEST(BadWorld, NamesThatWouldNotPrint) {
  EXPECT_REFUSED(kBox + "name = \"a\\u001b[2J\"\n", "printable");
  EXPECT_REFUSED(kBox + "name = \"" + std::string(65, 'a') + "\"\n", "printable");
  EXPECT_REFUSED(kBox + "[world]\nname = \"a\\nb\"\n", "printable");
  EXPECT_REFUSED(kBox + "colour = \"light blue\"\n", "colour");
}

TEST(BadWorld, KindsThatAreMostLikelyMisspelt) {
  EXPECT_REFUSED(kBox + "kind = \"lnie\"\n", "expected one of wall, goal, post, line");
  EXPECT_NO_THROW(worldOf(kBox + "kind = \"reflector\"\nidentity = 3\n"));
  EXPECT_REFUSED(kBox + "kind = \"a b\"\nidentity = 3\n", "kind");
}

TEST(BadWorld, LinesWithHeight) {
  EXPECT_REFUSED(kBox + "kind = \"line\"\nz_m = [0, 1]\n", "flat");
  EXPECT_REFUSED(
      "[[ellipse]]\nkind = \"line\"\ncenter_m = [3, 0]\nsize_m = [1, 2]\narc_deg = [90, 0]\n",
      "arc_deg");
}

TEST(BadWorld, LandmarksThatCannotBeToldApart) {
  const std::string mark = "[[landmark]]\nkind = \"tag\"\nidentity = 7\nposition_m = [1, 1]\n";
  EXPECT_REFUSED(mark + mark, "two landmarks are tag 7");
  EXPECT_REFUSED("[[landmark]]\nkind = \"tag\"\nposition_m = [1, 1]\n", "identity");
  EXPECT_REFUSED("[[landmark]]\nkind = \"\"\nidentity = 7\nposition_m = [1, 1]\n", "kind");
  EXPECT_REFUSED("[[landmark]]\nkind = \"tag\"\nidentity = 7\nposition_m = [1]\n", "[x, y, z]");
}

TEST(BadWorld, TooManyOfAnything) {
  std::string grids;
  for (int i = 0; i < 17; ++i) grids += "[[grid]]\nmap = \"gone.yaml\"\n";
  EXPECT_REFUSED(grids, "there are 17, expected at most 16");
}

TEST(BadWorld, MapsThatAreAllNoiseAreRefusedBeforeTheyTakeAllMemory) {
  const TemporaryFolder folder;
  std::string noise = "P5 3000 3000 255\n";
  Random random(5);
  for (int i = 0; i < 3000 * 3000; ++i) noise += random.uniform() < 0.5 ? '\0' : '\xfe';
  folder.write("map.pgm", noise);
  folder.write("map.yaml", mapYaml("map.pgm", "[0, 0, 0]", "0.05"));
  const std::string message = refusalOf(folder.write("world.toml", gridWorld()));
  EXPECT_NE(message.find("more than 2^21 walls"), std::string::npos) << message;
}

TEST(Landmarks, ComeFromPrimitivesAndMarksInOrderOfKindAndIdentity) {
  const auto world = worldOf(
      "[[ellipse]]\nkind = \"post\"\nidentity = 2\ncenter_m = [1, 2]\nsize_m = [0.2, 0.2]\nz_m = "
      "[0, 2]\n"
      "[[triangle]]\nkind = \"post\"\nidentity = 1\ncorners_m = [0, 0, 3, 0, 0, 3]\n"
      "[[landmark]]\nkind = \"barcode\"\nidentity = 72\nposition_m = [-1, -2, 0.4]\n");
  const auto marks = world->landmarks();
  ASSERT_EQ(marks.size(), 3u);
  EXPECT_EQ(marks[0].kind, "barcode");
  EXPECT_EQ(marks[0].identity, 72u);
  EXPECT_EQ(marks[0].z, 0.4);
  EXPECT_EQ(marks[1].identity, 1u);
  EXPECT_DOUBLE_EQ(marks[1].x, 1);
  EXPECT_DOUBLE_EQ(marks[1].y, 1);
  EXPECT_EQ(marks[2].identity, 2u);
  EXPECT_DOUBLE_EQ(marks[2].z, 1);
}

TEST(WorldBounds, AreTheBoxAroundEverythingUnlessGiven) {
  const auto world =
      worldOf(kBox + "[[ellipse]]\ncenter_m = [-2, 3]\nsize_m = [2, 4]\nangle_deg = 90\n");
  const FieldGrid grid = world->region(0.5, {0.1}).grid;
  EXPECT_NEAR(grid.originX, -4, 1e-12);
  EXPECT_NEAR(grid.originY, -1, 1e-12);
  EXPECT_EQ(grid.columns, 15);  // to x = 3.5
  EXPECT_EQ(grid.rows, 10);     // to y = 4
}

}  // namespace
}  // namespace ortung::test

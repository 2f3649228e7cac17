/// Worlds that consist of landmarks: their bounds, their text, and what they refuse.

#include "LogTesting.hpp"
#include "ortung/realsensors/OpenWorld.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

/// A file whose lines are landmarks, and a world to read them into.
class OpenWorldTest : public ::testing::Test {
 protected:
  /// Reads "identity x y" lines.
  void read(OpenWorld& world, const std::string& lines) const {
    LogFile file(folder_.write("places", lines));
    while (file.nextRecord())
      world.read(file, static_cast<std::uint32_t>(file.integer(0, "an identity", {})), 1);
  }
  std::string place() const { return (folder_.path() / "places").string(); }
  TemporaryFolder folder_;
};

TEST_F(OpenWorldTest, BeginsEmpty) {
  const OpenWorld world("post", 2.0);
  EXPECT_TRUE(world.isEmpty());
  EXPECT_FALSE(world.has(0));
  EXPECT_EQ(world.identities(), "");
  EXPECT_EQ(world.diagonal(), 0.0);
  const auto file = folder_.path() / "w.toml";
  EXPECT_EQ(errorOf([&] { world.write(file); }),
            file.string() + ": the log has no landmark for a world");
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(OpenWorldTest, KeepsTheOrderOfItsLandmarks) {
  OpenWorld world("post", 0.0);
  read(world, "9 0 0\n2 3 0\n4 0 4\n");
  EXPECT_EQ(world.identities(), "9, 2, 4");
  EXPECT_TRUE(world.has(2));
  EXPECT_FALSE(world.has(3));
  EXPECT_DOUBLE_EQ(world.diagonal(), 5.0);
  EXPECT_EQ(world.kind(), "post");
}

// A single landmark at (1, 2) with a margin of 3 m: 6 m x 6 m.
TEST_F(OpenWorldTest, HasAMarginOnEachSide) {
  OpenWorld world("a \"b\"", 3.0);
  read(world, "7 1 2\n");
  EXPECT_DOUBLE_EQ(world.diagonal(), 6.0 * std::sqrt(2.0));
  world.write(folder_.path() / "w.toml");
  EXPECT_EQ(readBytes(folder_.path() / "w.toml"),
            "[world]\nname = \"w\"\nx_m = [-2.0, 4.0]\ny_m = [-1.0, 5.0]\n"
            "\n[[landmark]]\nkind = \"a \\\"b\\\"\"\nidentity = 7\nposition_m = [1.0, 2.0]\n");
}

TEST_F(OpenWorldTest, RefusesALandmarkTwiceAndTheOneBehind256) {
  OpenWorld world("post", 0.0);
  EXPECT_EQ(errorOf([&] { read(world, "1 0 0\n\n1 5 5\n"); }),
            place() + ":3: found landmark 1 twice, expected each landmark once");
  OpenWorld full("post", 0.0);
  std::string lines;
  for (int i = 0; i < 256; ++i) lines += std::to_string(i) + " 0 0\n";
  read(full, lines);
  EXPECT_EQ(errorOf([&] { read(full, "256 0 0\n"); }),
            place() + ":1: found more landmarks, expected at most 256");
}

TEST_F(OpenWorldTest, TakesCoordinatesSomeFieldsApart) {
  OpenWorld world("anchor", 0.0);
  LogFile file(folder_.write("places", "| 1000 | -1000 | 100 |\n| 0 | 0 | 100.5 |\n"));
  ASSERT_TRUE(file.nextRecord());
  world.read(file, 0, 1, 2, true);
  world.write(folder_.path() / "w.toml");
  EXPECT_NE(readBytes(folder_.path() / "w.toml").find("position_m = [1000.0, -1000.0, 100.0]"),
            std::string::npos);
  ASSERT_TRUE(file.nextRecord());
  EXPECT_EQ(errorOf([&] { world.read(file, 1, 1, 2, true); }),
            place() + ":2: found '100.5' in field 6, expected z [m], a number in [0, 100]");
}

}  // namespace
}  // namespace ortung

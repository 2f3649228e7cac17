// Maps of worlds, as map_server reads them.
#include <cmath>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

class ExportedMap : public Workspace {
 protected:
  Outcome exportTo(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command = {"export", "map", path("hall.toml"), "--out", path(out)};
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  }
};

// The hall is 6 m x 4 m around the origin; two cells are around it.
TEST_F(ExportedMap, SaysWhereItsLowerLeftCornerIsAndHasTheTopRowFirst) {
  const Outcome outcome = exportTo("map.yaml", {"--cell", "0.1"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::string yaml = read("map.yaml");
  EXPECT_TRUE(yaml.starts_with("image: map.pgm\nresolution: 0.1\norigin: [")) << yaml;
  EXPECT_TRUE(yaml.ends_with(", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"));
  double x = 0.0;
  double y = 0.0;
  ASSERT_EQ(std::sscanf(yaml.c_str() + yaml.find('['), "[%lf, %lf", &x, &y), 2);
  EXPECT_NEAR(x, -3.2, 1e-9);
  EXPECT_NEAR(y, -2.2, 1e-9);
  const std::string pgm = read("map.pgm");
  int columns = 0;
  int rows = 0;
  ASSERT_EQ(std::sscanf(pgm.c_str(), "P5\n%d %d\n255\n", &columns, &rows), 2);
  EXPECT_EQ(outcome.out, path("map.yaml") + ": " + std::to_string(columns) + " x " +
                             std::to_string(rows) + " cells of 0.1 m\n");
  const std::size_t head = pgm.find("255\n") + 4;
  ASSERT_EQ(pgm.size() - head, static_cast<std::size_t>(columns * rows));
  const auto valueAt = [&](double atX, double atY) {
    const int column = static_cast<int>(std::floor((atX - x) / 0.1));
    const int row = static_cast<int>(std::floor((atY - y) / 0.1));
    const auto at = static_cast<std::size_t>((rows - 1 - row) * columns + column);
    return static_cast<int>(static_cast<unsigned char>(pgm.at(head + at)));
  };
  EXPECT_EQ(valueAt(0.05, 0.05), 254) << "open";
  EXPECT_EQ(valueAt(-2.65, 1.45), 0) << "the left side of the box on the upper left";
  EXPECT_EQ(valueAt(-2.15, 1.45), 205) << "its inside";
  EXPECT_EQ(valueAt(2.25, -0.45), 0) << "the upper left corner of the box on the lower right";
  EXPECT_EQ(valueAt(2.25, 0.45), 254) << "not mirrored";
}

/// A map_server map that was written by the program.
struct WrittenMap {
  double x = 0.0;
  double y = 0.0;
  int columns = 0;
  int rows = 0;
  std::string values;  ///< the top row first

  WrittenMap(const std::string& yaml, const std::string& pgm) {
    EXPECT_EQ(std::sscanf(yaml.c_str() + yaml.find('['), "[%lf, %lf", &x, &y), 2);
    EXPECT_EQ(std::sscanf(pgm.c_str(), "P5\n%d %d\n255\n", &columns, &rows), 2);
    values = pgm.substr(pgm.find("255\n") + 4);
  }
  /// The value at a place; unknown beside the map.
  int at(double atX, double atY) const {
    const auto column = static_cast<int>(std::floor((atX - x) / 0.1));
    const auto row = static_cast<int>(std::floor((atY - y) / 0.1));
    if (column < 0 || row < 0 || column >= columns || row >= rows) return 205;
    const auto i = static_cast<std::size_t>((rows - 1 - row) * columns + column);
    return static_cast<unsigned char>(values.at(i));
  }
  /// Whether all places within 0.15 m have this value, or whether any has.
  bool isAround(double atX, double atY, int value, bool all) const {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        if ((at(atX + 0.15 * dx, atY + 0.15 * dy) == value) != all) return !all;
    return all;
  }
};

// The map of a world whose map is turned shows the turned walls: along the axes of the field.
TEST_F(ExportedMap, OfATurnedMapHasItTurned) {
  constexpr double kYaw = 0.65;
  const std::vector<std::string> fine{"--cell", "0.1"};
  ASSERT_EQ(exportTo("straight.yaml", fine).exitCode, 0);
  std::string yaml = read("straight.yaml");
  const WrittenMap straight(yaml, read("straight.pgm"));
  const std::size_t end = yaml.find(", 0]");
  write("turned.yaml", yaml.substr(0, end) + ", 0.65]" + yaml.substr(end + 4));
  write("hall.toml", "[[grid]]\nmap = \"turned.yaml\"\nz_m = [0, 2]\n");
  ASSERT_EQ(exportTo("again.yaml", fine).exitCode, 0);
  const WrittenMap again(read("again.yaml"), read("again.pgm"));
  int free = 0;
  int walls = 0;
  for (double x = straight.x + 0.05; x < straight.x + 0.1 * straight.columns; x += 0.1)
    for (double y = straight.y + 0.05; y < straight.y + 0.1 * straight.rows; y += 0.1) {
      const double dx = x - straight.x;
      const double dy = y - straight.y;
      const double thereX = straight.x + std::cos(kYaw) * dx - std::sin(kYaw) * dy;
      const double thereY = straight.y + std::sin(kYaw) * dx + std::cos(kYaw) * dy;
      if (straight.isAround(x, y, 254, true)) {
        EXPECT_EQ(again.at(thereX, thereY), 254) << x << ", " << y;
        ++free;
      } else if (straight.at(x, y) == 0) {
        EXPECT_TRUE(again.isAround(thereX, thereY, 0, false)) << x << ", " << y;
        ++walls;
      }
    }
  EXPECT_GT(free, 1000);
  EXPECT_GT(walls, 100);
}

TEST_F(ExportedMap, ReplacesNeitherAMapNorItsPictureUnlessForced) {
  ASSERT_EQ(exportTo("map.yaml").exitCode, 0);
  expectRefused(exportTo("map.yaml"), 1, "ortung export map: " + path("map.yaml"), {"--force"});
  std::filesystem::remove(path("map.yaml"));
  write("map.pgm", "my own");
  expectRefused(exportTo("map.yaml"), 1, "ortung export map: " + path("map.pgm"), {"--force"});
  EXPECT_EQ(read("map.pgm"), "my own");
  EXPECT_FALSE(std::filesystem::exists(path("map.yaml")));
  EXPECT_EQ(exportTo("map.yaml", {"--force"}).exitCode, 0);
  EXPECT_TRUE(read("map.pgm").starts_with("P5\n"));
}

TEST_F(ExportedMap, WhatIsNoMapOrNoWorldIsNamed) {
  expectRefused(exportTo("map"), 2, "ortung export map: --out is '" + path("map"),
                {"expected NAME.yaml or NAME.gridmap"});
  expectRefused(exportTo("map.yaml", {"--cell", "0.004"}), 2, "ortung export map: --cell",
                {"0.005 to 10"});
  std::filesystem::remove(path("hall.toml"));
  expectRefused(exportTo("map.yaml"), 1, "ortung export map: " + path("hall.toml"), {});
}

}  // namespace
}  // namespace ortung::test

// A recording of a real robot in a map in which a piece of wall stands elsewhere.
#include <cmath>
#include <cstdio>

#include "Files.hpp"
#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

const std::string kData = ORTUNG_SHARED_DATA;

/// The map of the log, a grey picture with cells of 0.05 m.
class Map {
 public:
  explicit Map(const Folder& folder)
      : folder_(folder), bytes_(readBytes(folder.path("intel.pgm"))) {
    EXPECT_EQ(std::sscanf(bytes_.c_str(), "P5\n%d %d\n255\n", &columns_, &rows_), 2);
    const std::string yaml = readBytes(folder.path("intel.yaml"));
    EXPECT_EQ(std::sscanf(yaml.c_str() + yaml.find("origin"), "origin: [%lf, %lf", &left_, &low_),
              2);
    head_ = bytes_.find("255\n") + 4;
  }
  char& at(double x, double y) {
    const int column = static_cast<int>(std::floor((x - left_) / 0.05));
    const int row = rows_ - 1 - static_cast<int>(std::floor((y - low_) / 0.05));
    return bytes_.at(head_ + static_cast<std::size_t>(row * columns_ + column));
  }
  void write() const { writeBytes(folder_.path("intel.pgm"), bytes_); }

 private:
  const Folder& folder_;
  std::string bytes_;
  int columns_ = 0;
  int rows_ = 0;
  double left_ = 0.0;
  double low_ = 0.0;
  std::size_t head_ = 0;
};

TEST(ChangedMap, AWallThatStandsHalfAMetreIntoTheCorridorIsNoticedAndNothingElse) {
  const std::string log = kData + "/carmen/intel";
  if (!std::filesystem::exists(log))
    GTEST_SKIP() << log << " is not here; it belongs to no repository";
  const Folder folder;
  folder.run({"import", "scanlog", log, "--out", folder.path("intel.rec"), "--world",
              folder.path("intel.toml"), "--robot-file", folder.path("robot.toml")});
  const auto figures = [&] {
    folder.run({"learn", "--world", folder.path("intel.toml"), "--robot", folder.path("robot.toml"),
                "--out", folder.path("intel.ortung"), "--force"});
    return folder.eval({"--source", "record:" + folder.path("intel.rec"), "--robot",
                        folder.path("robot.toml"), "--tables", folder.path("intel.ortung"),
                        "--any-world"});
  };
  const auto before = figures();
  // The map has the leaf of a door at (7.8, 1.6), 0.7 m long, which is open in most passes.
  const int leaf = before["map_gone_cells"].get<int>();
  EXPECT_LE(leaf, 7);
  EXPECT_EQ(before["map_new_cells"], 0);

  // The wall of the corridor is at y = -21.5 m; 1.5 m of it are drawn at -22 m.
  Map map(folder);
  for (double x = 9.625; x < 11.1; x += 0.05) {
    for (double y = -22.0; y < -21.35; y += 0.05) map.at(x, y + 0.01) = static_cast<char>(205);
    map.at(x, -21.99) = 0;
  }
  map.write();
  const auto after = figures();
  EXPECT_GE(after["map_gone_cells"].get<int>(), leaf + 5) << "of 15";
  EXPECT_LE(after["map_gone_cells"].get<int>(), 18 + 7);
  EXPECT_LT(after["position_median_m"].get<double>(),
            1.1 * before["position_median_m"].get<double>());
}

}  // namespace
}  // namespace ortung::test

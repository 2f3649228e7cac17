// A node's own maps: what a world file names, what is told of a map file, and what is asked of
// load_map. Maps of a few cells, whose occupancies are computed by hand.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "../support/Files.hpp"
#include "FloorOptions.hpp"
#include "LikelihoodMap.hpp"
#include "LiveMaps.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::ros2 {
namespace {

using Floors = std::vector<std::pair<std::string, std::filesystem::path>>;

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Writes a map of 3 x 2 cells: above black, grey and white, below white.
void writeMap(const std::filesystem::path& yaml) {
  std::filesystem::path image = yaml;
  image.replace_extension(".pgm");
  write(image, std::string("P5\n3 2\n255\n\x00\xcd\xfe\xfe\xfe\xfe", 17));
  write(yaml, "image: " + image.filename().string() +
                  "\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\n"
                  "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

Floors floorsOf(const OwnWorld& world) {
  Floors all;
  for (const auto& [floor, file] : world.maps) all.emplace_back(floor, file);
  return all;
}

LoadedMap load(LiveMaps& maps, const std::string& url) {
  LoadedMap loaded;
  readCdr(maps.load(cdrOf(url)), loaded);
  return loaded;
}

TEST(OwnWorld, NamesTheMapsOfItsFloors) {
  const test::TemporaryFolder folder;
  const auto file = folder / "house.toml";
  write(file,
        "[world]\nname = \"house\"\n[[floor]]\nname = \"ground\"\nmap = \"maps/g.yaml\"\n"
        "[[floor]]\nname = \"first\"\n[[floor]]\nname = \"hall\"\n"
        "[[grid]]\nfloor = \"first\"\nmap = \"/f.yaml\"\n"
        "[[rectangle]]\nfloor = \"hall\"\ncentre_m = [0, 0]\nsize_m = [1, 1]\n");
  const OwnWorld world = readOwnWorld(file);
  EXPECT_EQ(floorsOf(world),
            (Floors{{"ground", folder / "maps/g.yaml"}, {"first", "/f.yaml"}, {"hall", ""}}));
  EXPECT_EQ(world.mapOf("first")->file, "/f.yaml");
  EXPECT_EQ(world.mapOf("")->floor, "ground") << "none is known yet";
  EXPECT_EQ(world.mapOf("hall"), nullptr) << "made of rectangles";
  EXPECT_EQ(world.find("hall")->floor, "hall");
  EXPECT_EQ(world.find("cellar"), nullptr);
  EXPECT_EQ(world.find(""), nullptr);
}

TEST(OwnWorld, IsAMapAloneToo) {
  const test::TemporaryFolder folder;
  write(folder / "one.toml", "[[grid]]\nmap = \"g.yaml\"\n");
  EXPECT_EQ(floorsOf(readOwnWorld(folder / "one.toml")), (Floors{{"", folder / "g.yaml"}}));
  write(folder / "two.toml", "[[grid]]\nmap = \"g.yaml\"\n[[grid]]\nmap = \"h.yaml\"\n");
  EXPECT_TRUE(readOwnWorld(folder / "two.toml").maps.empty()) << "which of them?";
  write(folder / "bad.toml", "[[floor]]\nmap = 3\n");
  EXPECT_THROW(readOwnWorld(folder / "bad.toml"), ConfigError);
  EXPECT_THROW(readOwnWorld(folder / "none.toml"), ConfigError);
}

TEST(OwnWorld, ReadsMapsAsMapServerTellsThem) {
  const test::TemporaryFolder folder;
  writeMap(folder / "m.yaml");
  const OccupancyGrid map = readOccupancyGrid(folder / "m.yaml", "map", 7);
  EXPECT_EQ(map.header.frame, "map");
  EXPECT_EQ(map.mapLoadTime, 7);
  EXPECT_EQ(map.width, 3U);
  EXPECT_EQ(map.height, 2U);
  EXPECT_FLOAT_EQ(map.resolution, 0.5F);
  EXPECT_EQ(map.origin.position.x, -1.0);
  EXPECT_EQ(map.origin.position.y, 2.0);
  EXPECT_EQ(map.origin.orientation.w, 1.0);
  EXPECT_EQ(map.data, (std::vector<std::int8_t>{0, 0, 0, 100, -1, 0})) << "the lower row first";
}

class LiveMapsTest : public testing::Test {
 protected:
  LiveMapsTest() {
    for (const char* name : {"ground.yaml", "first.yaml", "other.yaml"}) writeMap(folder_ / name);
    std::filesystem::create_directory(folder_ / "cache");
    write(folder_ / "cache/building.toml",
          buildingToml({"ground=" + path("ground.yaml"), "first=" + path("first.yaml")}, {}));
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  LiveMaps maps() {
    return {readOwnWorld(folder_ / "cache/building.toml"),
            {"map", "map", folder_ / "cache"},
            requests_};
  }

  const test::TemporaryFolder folder_;
  LiveRequests requests_{"map"};
};

TEST_F(LiveMapsTest, TakeAFloorByItsNameOrItsMap) {
  LiveMaps all = maps();
  const auto expectFloor = [&](const std::string& url, const std::string& floor) {
    const LoadedMap loaded = load(all, url);
    EXPECT_EQ(loaded.result, LoadedMap::kSuccess) << url;
    EXPECT_EQ(loaded.map.data.size(), 6U);
    EXPECT_EQ(requests_.take().floor, floor) << url;
    EXPECT_FALSE(all.isAnotherWanted());
  };
  expectFloor("first", "first");
  expectFloor(path("first.yaml"), "first");
  expectFloor("file://" + path("first.yaml"), "first");
  expectFloor(path("cache/../ground.yaml"), "ground");
}

TEST_F(LiveMapsTest, WantAnotherWorldAndTheFirstOneAgain) {
  LiveMaps all = maps();
  EXPECT_EQ(load(all, path("other.yaml")).result, LoadedMap::kSuccess);
  ASSERT_TRUE(all.isAnotherWanted());
  const LiveMaps::Wanted other = all.takeWanted();
  EXPECT_FALSE(all.isAnotherWanted());
  EXPECT_EQ(other.floor, "");
  EXPECT_EQ(floorsOf(readOwnWorld(other.world.file)), (Floors{{"", path("other.yaml")}}));
  all.use(other.world);
  // The same file again may have another map by now.
  EXPECT_EQ(load(all, path("other.yaml")).result, LoadedMap::kSuccess);
  ASSERT_TRUE(all.isAnotherWanted());
  EXPECT_EQ(all.takeWanted().world.file, other.world.file);
  // A floor of the building means the whole of it.
  EXPECT_EQ(load(all, "first").result, LoadedMap::kSuccess);
  ASSERT_TRUE(all.isAnotherWanted());
  const LiveMaps::Wanted back = all.takeWanted();
  EXPECT_EQ(back.floor, "first");
  EXPECT_EQ(back.world.file, folder_ / "cache/building.toml");
  EXPECT_FALSE(requests_.take().floor) << "not before that world is in force";
}

TEST_F(LiveMapsTest, AnswerWhatIsWrong) {
  LiveMaps all = maps();
  write(folder_ / "bad.yaml", "resolution: 0\n");
  write(folder_ / "list.yaml", "- [[[[");
  write(folder_ / "torn.yaml", "image: torn.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  write(folder_ / "torn.pgm", "P5\n99999 99999\n255\n");
  write(folder_ / "noise.map", std::string(100, '\xff'));
  const std::string zero("ground\0", 7);
  for (const auto& [url, result] : std::vector<std::pair<std::string, std::uint8_t>>{
           {"", LoadedMap::kNoSuchMap},
           {zero, LoadedMap::kNoSuchMap},
           {"cellar", LoadedMap::kNoSuchMap},
           {path("cache"), LoadedMap::kNoSuchMap},
           {"/dev/zero", LoadedMap::kNoSuchMap},
           {std::string(100'000, 'x'), LoadedMap::kNoSuchMap},
           {"file://", LoadedMap::kNoSuchMap},
           {path("bad.yaml"), LoadedMap::kInvalidMetadata},
           {path("list.yaml"), LoadedMap::kInvalidMetadata},
           {path("torn.yaml"), LoadedMap::kInvalidData},
           {path("noise.map"), LoadedMap::kInvalidData},
           {path("torn.pgm"), LoadedMap::kInvalidData}}) {
    const LoadedMap loaded = load(all, url);
    EXPECT_EQ(loaded.result, result) << url.substr(0, 100);
    EXPECT_TRUE(loaded.map.data.empty());
  }
  EXPECT_FALSE(all.isAnotherWanted());
  EXPECT_FALSE(requests_.take().floor);
  EXPECT_THROW(all.load(std::string("\0\1\0\0\xff\xff\xff\xff", 8)), std::invalid_argument);
  EXPECT_THROW(all.load(""), std::invalid_argument);
}

TEST(FloorOptions, WriteABuilding) {
  const Parameters toml = parseToml(buildingToml({"ground=/maps/g.yaml", "first-1=/maps/a=b.yaml"},
                                                 {"east=12.5,-3", "west=1,2,1.5"}),
                                    "building");
  const auto floors = toml.tables("floor");
  ASSERT_EQ(floors.size(), 2U);
  EXPECT_EQ(floors[0].text("name"), "ground");
  EXPECT_EQ(floors[0].text("map"), "/maps/g.yaml");
  EXPECT_EQ(floors[0].number("map_error_m"), 0.02) << "as of other maps of real robots";
  EXPECT_EQ(floors[1].text("name"), "first-1");
  EXPECT_EQ(floors[1].text("map"), "/maps/a=b.yaml");
  const auto lifts = toml.tables("lift");
  ASSERT_EQ(lifts.size(), 2U);
  EXPECT_EQ(lifts[0].numbers("position_m"), (std::vector<double>{12.5, -3.0}));
  EXPECT_EQ(lifts[0].number("radius_m"), 1.0);
  EXPECT_FALSE(lifts[0].has("floor")) << "it stops everywhere";
  EXPECT_EQ(lifts[1].number("radius_m"), 1.5);
}

TEST(FloorOptions, RefuseWhatTheyDoNotUnderstand) {
  for (const char* floor : {"", "=", "ground", "ground=", "=g.yaml", "gr und=g.yaml"})
    EXPECT_THROW(buildingToml({floor}, {}), std::invalid_argument) << floor;
  EXPECT_THROW(buildingToml({"a=1.yaml", "a=2.yaml"}, {}), std::invalid_argument);
  for (const char* lift : {"", "l", "l=", "l=1", "l=1,", "l=1;2", "l=1,2,", "l=1,2,3,4", "l=1,2x",
                           "l=1,2,0", "l=1,2,21", "l=nan,1", "l=1e9,1"})
    EXPECT_THROW(buildingToml({"a=1.yaml"}, {lift}), std::invalid_argument) << lift;
}

TEST(LikelihoodMap, IsCutToAFloor) {
  FieldRegion field;
  field.grid = {-1.0, 0.0, 1.0, 8, 2};  // x from -1 to 7
  for (std::uint8_t cell = 0; cell < 16; ++cell) field.open.push_back(cell);
  field.standable = field.open;
  const FieldRegion part = LikelihoodMap::partOf(field, {"first", 4.0, 3.0, 100.0});
  EXPECT_EQ(part.grid, (FieldGrid{3.0, 0.0, 1.0, 4, 2}));
  EXPECT_EQ(part.open, (std::vector<std::uint8_t>{4, 5, 6, 7, 12, 13, 14, 15}));
  EXPECT_EQ(part.standable, part.open);
  const FieldRegion first = LikelihoodMap::partOf(field, {"ground", 0.0, -50.0, 3.0});
  EXPECT_EQ(first.grid, (FieldGrid{-1.0, 0.0, 1.0, 4, 2}));
  EXPECT_EQ(first.open, (std::vector<std::uint8_t>{0, 1, 2, 3, 8, 9, 10, 11}));
}

TEST(OwnWorldTest, TablesOfOtherFloorsAreRefused) {
  const OwnWorld world{"b.toml", {{"a", "a.yaml"}, {"b", ""}}};
  Building learned;
  learned.floors = {{"a", 0.0, -5.0, 5.0}, {"b", 10.0, 5.0, 15.0}};
  EXPECT_NO_THROW(world.checkFloors(learned));
  learned.floors[1].name = "c";
  try {
    world.checkFloors(learned);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the tables have the floors a, c, expected those of b.toml: a, b");
  }
  EXPECT_THROW(world.checkFloors({}), std::runtime_error);
  const OwnWorld plain{"w.toml", {{"", "a.yaml"}}};
  EXPECT_NO_THROW(plain.checkFloors({}));
  EXPECT_THROW(plain.checkFloors(learned), std::runtime_error);
}

}  // namespace
}  // namespace ortung::ros2

// What the READMEs of plugins say about keys of robot files, against what the plugins ask for.
// docs/robots.md has the same tables; scripts/robots-page.py keeps them so.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "Files.hpp"
#include "KnownKeys.hpp"
#include "Paths.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim_api/Drive.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

namespace fs = std::filesystem;
using Keys = std::set<std::string>;

/// The keys in the first column of the tables of a page whose head begins with @p head.
Keys keysOfPage(const fs::path& page, const std::string& head) {
  std::ifstream in(page);
  EXPECT_TRUE(in.good()) << page;
  Keys keys;
  bool inTable = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("| " + head + " |", 0) == 0) {
      inTable = true;
      continue;
    }
    if (line.rfind("|", 0) != 0) inTable = false;
    if (!inTable) continue;
    const std::string cell = line.substr(1, line.find('|', 1) - 1);
    static const std::regex code("`([a-z_0-9]+(\\.\\.\\.)?)[^`]*`");
    for (std::sregex_iterator it(cell.begin(), cell.end(), code), end; it != end; ++it)
      keys.insert((*it)[1]);
  }
  return keys;
}

/// The keys that the error names which `nobody_knows_this = 1` in @p toml brings about.
template <class Make>
Keys knownKeys(const Make& make, const std::string& toml) {
  const auto error = test::messageOf<ConfigError>([&] { make(parseToml(toml, "test.toml")); });
  return test::keysKnownIn(error, "nobody_knows_this");
}

const std::string kUnknown = "\nnobody_knows_this = 1\n";

Keys without(Keys keys, const Keys& left) {
  for (const std::string& key : left) keys.erase(key);
  return keys;
}

/// "odometry_..." stands for all such keys of the drive "differential".
Keys expanded(const Keys& keys) {
  Keys all;
  for (const std::string& key : keys) {
    if (key != "odometry_...") {
      all.insert(key);
      continue;
    }
    const fs::path differential =
        fs::path(ORTUNG_SOURCE_DIR) / "plugins/motion/differential/README.md";
    for (const std::string& one : keysOfPage(differential, "key"))
      if (one.rfind("odometry_", 0) == 0) all.insert(one);
  }
  return all;
}

std::string listOf(const Keys& keys) {
  std::string list;
  for (const std::string& key : keys) list += key + " ";
  return list;
}

struct SensorPage {
  const char* plugin;
  const char* folder;
  std::vector<const char*> settings;  ///< ways to write the table that ask for different keys
  Keys unsaid = {};                   ///< asked for, too, but without effect on this plugin
  bool hasSensor = true;              ///< a simulation half
};

void PrintTo(const SensorPage& page, std::ostream* out) {  // NOLINT: GoogleTest looks for this name
  *out << page.plugin;
}

class EachSensor : public testing::TestWithParam<SensorPage> {};

TEST_P(EachSensor, HasTheKeysOfItsReadme) {
  const SensorPage& page = GetParam();
  PluginFactory factory(PluginFactory::standardFolders());
  Keys known;
  for (const char* settings : page.settings) {
    known.merge(knownKeys([&](const Parameters& p) { factory.makeData(page.plugin, p); },
                          settings + kUnknown));
    if (!page.hasSensor) continue;
    known.merge(knownKeys([&](const Parameters& p) { factory.make<Sensor>(page.plugin, p); },
                          settings + kUnknown));
  }
  const Keys said = keysOfPage(
      fs::path(ORTUNG_SOURCE_DIR) / "plugins/sensors" / page.folder / "README.md", "key");
  EXPECT_EQ(listOf(without(said, {"plugin"})),
            listOf(without(without(known, {"plugin"}), page.unsaid)));
}

INSTANTIATE_TEST_SUITE_P(
    Plugins, EachSensor,
    testing::Values(
        SensorPage{"lrf", "lrf", {"", "first_angle_deg = 0\nangle_step_deg = 1"}},
        SensorPage{"lrf_iconic", "lrf_iconic", {"", "reads = \"*/LRF/*\""}, {"feature"}},
        SensorPage{"lrf_cylinders",
                   "lrf_cylinders",
                   {"reads = \"*/LRF/*\"\nradius_m = 0.05"},
                   {"max_range_mass"}},
        SensorPage{"sonar", "sonar", {""}},
        SensorPage{"iconic_omnivision", "iconic", {""}, {"feature"}},
        SensorPage{"iconic_camera", "iconic", {""}, {"feature"}},
        SensorPage{
            "landmarks", "landmarks", {"", "features = \"list\""}, {"feature", "max_range_mass"}},
        SensorPage{"compass", "compass", {""}, {"max_range_mass"}},
        SensorPage{"odometry", "odometry", {""}}, SensorPage{"ground_truth", "ground_truth", {""}},
        SensorPage{"teammate", "teammate", {""}, {"feature"}, false}),
    [](const auto& instance) { return std::string(instance.param.plugin); });

TEST(SensorKeys, OfTablesWithinTablesAreThoseOfThePage) {
  PluginFactory factory(PluginFactory::standardFolders());
  const auto known = [&](const std::string& plugin, const std::string& toml) {
    return listOf(knownKeys([&](const Parameters& p) { factory.makeData(plugin, p); }, toml));
  };
  EXPECT_EQ(known("lrf", "[pose]" + kUnknown), "theta_deg x_m y_m z_m ");
  const fs::path page = fs::path(ORTUNG_SOURCE_DIR) / "docs/robots.md";
  const auto said = [&](const std::string& head) { return keysOfPage(page, head); };
  EXPECT_EQ(known("iconic_camera", "[lines]" + kUnknown), listOf([&] {
              Keys keys = said("key of `lines`");
              keys.insert("max_range_mass");  // asked for with the rest of the sensor model
              return keys;
            }()));
  Keys landmarks;
  for (const std::string more : {"identified = true", "identified = false"})
    landmarks.merge(knownKeys([&](const Parameters& p) { factory.makeData("iconic_camera", p); },
                              "[posts]\n" + more + kUnknown));
  EXPECT_EQ(listOf(without(landmarks, {"max_range_mass"})),
            listOf(said("key of `goals`, `posts`")));
}

TEST(RobotKeys, OfTheSectionsAreThoseOfThePage) {
  const fs::path page = fs::path(ORTUNG_SOURCE_DIR) / "docs/robots.md";
  const auto read = [](const Parameters& p) { RobotShape::read(readRobot(p)); };
  const std::string sensor = "[[sensor]]\nplugin = \"odometry\"\n";
  const std::string body = "center_m = [0, 0]\nsize_m = [1, 1]\n";
  const std::string state = "[[manipulator]]\nname = \"m\"\n[[manipulator.state]]\nname = \"s\"\n";
  const Keys robot = knownKeys(read, sensor + "[robot]" + kUnknown);
  EXPECT_EQ(listOf(robot), "colour mass_kg name radius_m ");
  Keys pieces = knownKeys(read, sensor + "[[body]]\n" + body + kUnknown);
  pieces.merge(knownKeys(
      read, sensor + "[[body]]\nshape = \"triangle\"\ncorners_m = [0,0,1,0,0,1]" + kUnknown));
  EXPECT_EQ(listOf(pieces), listOf(keysOfPage(page, "key of `[[body]]`")));
  EXPECT_EQ(listOf(knownKeys(read, sensor + state + kUnknown)),
            listOf(keysOfPage(page, "key of `[[manipulator.state]]`")));
  EXPECT_EQ(listOf(knownKeys(read, sensor + "[[manipulator]]\nname = \"m\"" + kUnknown +
                                       "[[manipulator.state]]\nname = \"s\"\n")),
            listOf(keysOfPage(page, "key of `[[manipulator]]`")));
}

TEST(RobotKeys, TheLeastFileOfThePageLocalizesWithTheDefaultsThatItTells) {
  std::ifstream in(fs::path(ORTUNG_SOURCE_DIR) / "docs/robots.md");
  std::string toml;
  bool isIn = false;
  for (std::string line; std::getline(in, line);) {
    if (line.find("<!-- smallest robot ends") == 0) isIn = false;
    if (isIn && line.find("```") != 0) toml += line + "\n";
    if (line.find("<!-- smallest robot begins") == 0) isIn = true;
  }
  ASSERT_NE(toml.find("[robot]"), toml.npos);
  const RobotConfig robot = readRobot(parseToml(toml, "robots.md"));
  EXPECT_EQ(robot.mass, 10.0);
  EXPECT_EQ(readRobot(parseToml("[[sensor]]\nplugin = \"odometry\"", "r")).radius, 0.25);
  SensorContainer container;
  PluginFactory factory(PluginFactory::standardFolders());
  fillContainer(container, robot, factory);
  EXPECT_NE(container.find({.type = "LRF"}), nullptr);
  EXPECT_NE(container.find({.type = "odometry"}), nullptr);
}

TEST(DriveKeys, AreThoseOfTheReadmes) {
  PluginFactory factory(PluginFactory::standardFolders());
  for (const std::string plugin : {"differential", "omni"}) {
    const Keys known =
        knownKeys([&](const Parameters& p) { factory.make<Drive>(plugin, p); }, kUnknown);
    const fs::path page = fs::path(ORTUNG_SOURCE_DIR) / "plugins/motion" / plugin / "README.md";
    const Keys said = expanded(keysOfPage(page, plugin == "omni" ? "key of `[drive]`" : "key"));
    EXPECT_EQ(listOf(without(said, {"plugin", "body_height_m"})),
              listOf(without(known, {"plugin", "body_height_m"})))
        << plugin;
  }
}

TEST(MotionKeys, AreThoseOfThePage) {
  PluginFactory factory(PluginFactory::standardFolders());
  const Keys known =
      knownKeys([&](const Parameters& p) { factory.make<MotionModel>("odometry", p); }, kUnknown);
  const Keys said = keysOfPage(fs::path(ORTUNG_SOURCE_DIR) / "docs/motion.md", "key of `[motion]`");
  EXPECT_EQ(listOf(without(said, {"plugin"})), listOf(without(known, {"plugin"})));
}

}  // namespace
}  // namespace ortung

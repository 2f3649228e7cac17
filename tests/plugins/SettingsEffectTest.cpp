#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "Files.hpp"
#include "KnownKeys.hpp"
#include "MotionRig.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"
#include "ortung/sim/SimWorld.hpp"

/// Each setting of each plugin changes something that it gives: names, words, tables, weights,
/// times. What the plugins know they say themselves, so a setting without a line here fails the
/// test, too. That the change is the right one is for the tests of each plugin.
namespace ortung {
namespace {

using Settings = std::map<std::string, std::string>;  ///< key -> TOML value

/// What is changed, and what else must be there for it to matter.
struct Change {
  std::string key;  ///< "lines.rays" is a key of the table lines
  std::string value;
  Settings with = {};
};

/// "a.b" become inline tables.
std::string toml(const Settings& settings) {
  std::map<std::string, std::string> tables;
  std::string text;
  for (const auto& [key, value] : settings) {
    const std::size_t dot = key.find('.');
    if (dot == key.npos)
      text += key + " = " + value + "\n";
    else
      tables[key.substr(0, dot)] +=
          (tables[key.substr(0, dot)].empty() ? "" : ", ") + key.substr(dot + 1) + " = " + value;
  }
  for (const auto& [name, content] : tables) text += name + " = { " + content + " }\n";
  return text;
}

/// All keys that a table knows, from the error about one that it does not.
std::set<std::string> knownTo(const std::function<void(const std::string&)>& make,
                              const Settings& settings, const std::string& table) {
  Settings wrong = settings;
  wrong[table + "no_such_key"] = "1";
  const auto said = test::messageOf<ConfigError>([&] { make(toml(wrong)); });
  std::set<std::string> keys;
  for (const std::string& key : test::keysKnownIn(said, "no_such_key")) keys.insert(table + key);
  return keys;
}

std::unique_ptr<SimWorld> field() {
  const test::TemporaryFolder folder;
  const auto wall = [](const std::string& centre, const std::string& size) {
    return "[[rectangle]]\nkind = \"wall\"\ncenter_m = [" + centre + "]\nsize_m = [" + size + "]\n";
  };
  const auto mark = [](const std::string& kind, const std::string& identity,
                       const std::string& place) {
    return "[[landmark]]\nkind = \"" + kind + "\"\nidentity = " + identity + "\nposition_m = [" +
           place + "]\n";
  };
  test::writeBytes(
      folder / "world.toml",
      "[world]\nx_m = [-3, 3]\ny_m = [-2, 2]\n" + wall("3.05, 0", "0.1, 4.2") +
          wall("-3.05, 0", "0.1, 4.2") + wall("0, 2.05", "6.2, 0.1") +
          wall("0, -2.05", "6.2, 0.1") + wall("1.2, -1.3", "0.8, 0.5") +
          mark("post", "1", "2.6, 1.4, 0.5") + mark("post", "2", "-2.5, 1.5, 0.5") +
          mark("goal", "1", "-2.6, 0.1, 0.4") + mark("goal", "2", "2.7, 0.2, 0.4") +
          mark("beacon", "1", "0.9, 1.7, 0.5") +
          "[[rectangle]]\nkind = \"line\"\ncenter_m = [0.6, 0]\nsize_m = [0.08, 3.6]\n");
  auto world = readWorld(folder / "world.toml");
  const auto add = [&](const char* kind, double x, double y, double radius) {
    Primitive round;
    round.shape = Primitive::Shape::kEllipse;
    round.halfX = round.halfY = radius;
    round.zHigh = 0.8;
    world->addBody({kind, "", "red", {round}}, {x, y, 0});
  };
  add("robot", 1.5, 0.9, 0.25);
  add("ball", 2.0, 1.15, 0.11);  // half hidden by the robot
  add("obstacle", -1.5, -0.9, 0.15);
  add("obstacle", -2.371, 1.423, 0.05);  // so near before a post that it may be its own
  return world;
}

void add(std::string& text, double value) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.9g ", value);
  text += digits;
}

/// All that the halves of a sensor give: names, periods, words with noise, tables and weights.
std::string fingerprint(const SimWorld& world, const std::string& plugin,
                        const std::string& settings) {
  SensorRig rig(plugin, settings);
  std::string text;
  add(text, rig.sensor->period());
  add(text, rig.sensor->rays());
  const FieldRegion region = world.region(1.0, {0.2, 0.5});
  for (SensorData* data : rig.data) {
    text += toText(data->id()) + " " + data->learningKey() + (data->localizes() ? " +" : " -");
    add(text, data->mount().x);
    add(text, data->mount().y);
    add(text, data->mount().theta);
    if (data->localizes()) data->beginLearning(region, 0.2);
  }
  const bool learns = std::any_of(rig.data.begin(), rig.data.end(), [](const SensorData* data) {
    return data->localizes() && data->headingSpacing() > 0.0;
  });
  for (std::size_t cell = 0; learns && cell < region.grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    for (int h = 0; h < 8; ++h) {
      const Pose2 pose{region.grid.centreX(cell), region.grid.centreY(cell), wrapAngle(0.8 * h)};
      rig.sense(world, pose);
      for (SensorData* data : rig.data)
        if (data->localizes()) data->learnProbability(pose * inverse(data->mount()));
    }
  }
  for (SensorData* data : rig.data)
    if (data->localizes()) data->endLearning();
  Random noise(7);
  for (int i = 0; i < 20; ++i) {
    const Pose2 pose{-0.9 + 0.09 * i, 0.3 - 0.04 * i, 0.4 * i};
    rig.sense(world, pose, &noise);
    for (const SensorData* data : rig.data) {
      text += "\n";
      for (const std::uint32_t word : data->getData()) add(text, word);
      for (const double off : {0.0, 0.12, 0.9})
        add(text, data->getProbability({pose.x + off, pose.y, pose.theta + 0.3 * off}));
    }
  }
  return text;
}

void expectEffects(const std::string& plugin, const Settings& base,
                   const std::vector<Change>& changes, const std::vector<std::string>& tables,
                   const std::set<std::string>& without,
                   const std::function<std::string(const std::string&)>& print) {
  std::set<std::string> tried = without;
  std::map<std::string, std::string> printed;
  for (const Change& change : changes) {
    Settings before = base;
    for (const auto& [key, value] : change.with) before[key] = value;
    Settings after = before;
    after[change.key] = change.value;
    const std::string text = toml(before);
    if (!printed.contains(text)) printed[text] = print(text);
    EXPECT_TRUE(printed[text] != print(toml(after)))
        << plugin << ": " << change.key << " = " << change.value << " has no effect";
    tried.insert(change.key);
  }
  for (const std::string& table : tables)
    for (const std::string& key : knownTo([&](const std::string& t) { print(t); }, base, table))
      EXPECT_TRUE(tried.contains(key)) << plugin << ": the setting " << key << " is not tried here";
}

void expectSensorEffects(const std::string& plugin, const Settings& base,
                         std::vector<Change> changes, std::vector<std::string> tables = {""},
                         const std::set<std::string>& without = {"pose"}) {
  const auto world = field();
  tables.push_back("pose.");
  for (const auto& [key, value] :
       {std::pair{"pose.x_m", "0.2"}, {"pose.y_m", "-0.1"}, {"pose.theta_deg", "25"}})
    changes.push_back({key, value});
  expectEffects(plugin, base, changes, tables, without,
                [&](const std::string& settings) { return fingerprint(*world, plugin, settings); });
}

std::vector<Change> names() {
  return {{"model", "'other'"}, {"type", "'other'"}, {"feature", "'other'"}};
}

std::vector<Change> together(std::vector<Change> a, const std::vector<Change>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(SettingsEffect, OfTheCompass) {
  expectSensorEffects("compass", {},
                      together(names(), {{"period_s", "0.7"},
                                         {"north_deg", "40"},
                                         {"sigma_deg", "4"},
                                         {"noise_sigma_deg", "1"},
                                         {"outliers", "0.3"},
                                         {"exponent", "0.5"}}),
                      {""}, {"pose", "pose.z_m", "max_range_mass"});
}

TEST(SettingsEffect, OfTheLaserRangeFinder) {
  const Settings coarse{{"beams", "31"}, {"fov_deg", "150"}};
  expectSensorEffects(
      "lrf", coarse,
      together(names(), {{"period_s", "0.7"},
                         {"beams", "16"},
                         {"fov_deg", "90"},
                         {"first_angle_deg", "-20"},
                         {"max_range_m", "2"},
                         {"min_range_m", "1.2"},
                         {"perception", "'endpoints'"},
                         {"sigma_m", "0.3"},
                         {"sigma_per_m", "0.2"},
                         {"outliers", "0.2"},
                         {"max_range_mass", "0.6", {{"max_range_m", "2.5"}}},
                         {"exponent", "0.8"},
                         {"resolution_m", "0.2"},
                         {"resolution_per_m", "0.2"},
                         {"localizes", "false"},
                         {"used_beams", "5"},
                         {"endpoint_cell_m", "0.3", {{"perception", "'endpoints'"}}},
                         {"noise_sigma_m", "0.2"},
                         {"noise_sigma_per_m", "0.2"},
                         {"dropout_share", "0.4"},
                         {"pose.z_m", "1.4"}}),
      {""}, {"pose", "angle_step_deg"});
  const auto world = field();  // in place of fov_deg
  EXPECT_NE(fingerprint(*world, "lrf", "beams = 31\nangle_step_deg = 2"),
            fingerprint(*world, "lrf", "beams = 31\nangle_step_deg = 3"));
}

TEST(SettingsEffect, OfTheSonar) {
  const Settings ring{{"angles_deg", "[0, 90, 180, 270]"}};
  expectSensorEffects(
      "sonar", ring,
      together(
          names(),
          {{"period_s", "0.7"},          {"firing_order", "[3, 2, 1, 0]", {{"fire_at_once", "1"}}},
           {"fire_at_once", "2"},        {"angles_deg", "[0, 45, 180, 270]"},
           {"ring_radius_m", "0.05"},    {"opening_deg", "60"},
           {"min_range_m", "1.5"},       {"max_range_m", "1.2"},
           {"sigma_m", "0.2"},           {"sigma_per_m", "0.2"},
           {"resolution_m", "0.2"},      {"resolution_per_m", "0.2"},
           {"outliers", "0.3"},          {"max_range_mass", "0.6", {{"missed_share", "0.4"}}},
           {"exponent", "0.5"},          {"noise_sigma_m", "0.2"},
           {"noise_sigma_per_m", "0.2"}, {"missed_share", "0.4"},
           {"false_share", "0.4"},       {"pose.z_m", "1.4"}}));
}

TEST(SettingsEffect, OfLandmarks) {
  std::vector<Change> own = {{"period_s", "0.7"},
                             {"kind", "'beacon'", {{"identities", "[1]"}}},
                             {"features", "'list'"},
                             {"identities", "[2, 1]"},
                             {"min_range_m", "3"},
                             {"max_range_m", "2"},
                             {"fov_deg", "100"},
                             {"slant", "true"},
                             {"range_scale", "1.2"},
                             {"range_sigma_m", "0.4"},
                             {"range_sigma_per_m", "0.4"},
                             {"bearing_sigma_deg", "9"},
                             {"outliers", "0.3"},
                             {"exponent", "0.5"},
                             {"slack_m", "0"},
                             {"occlusion", "false", {{"slack_m", "0"}}},
                             {"noise_range_sigma_m", "0.5"},
                             {"noise_range_sigma_per_m", "0.3"},
                             {"noise_bearing_sigma_deg", "9"},
                             {"missed_share", "0.4"},
                             {"false_share", "0.4"},
                             {"pose.z_m", "1.6", {{"slack_m", "0"}}}};
  const Settings list{{"features", "'list'"}};
  own.push_back({"identified", "false", list});
  for (const char* key :
       {"range_bias_m", "range_bias_per_m", "range_bias_per_m_rad", "range_bias_per_m_rad2",
        "bearing_bias_deg", "bearing_bias_per_rad", "bearing_bias_per_rad2"})
    own.push_back({key, "0.2", list});
  expectSensorEffects("landmarks", {{"identities", "[1, 2]"}},
                      together(own, {{"model", "'other'"}, {"type", "'other'"}}), {""},
                      {"pose", "feature", "max_range_mass"});
  const auto world = field();  // only a list has it
  EXPECT_NE(fingerprint(*world, "landmarks", "features = 'list'"),
            fingerprint(*world, "landmarks", "features = 'list'\nfeature = 'other'"));
}

std::vector<Change> ofCameras() {
  std::vector<Change> all = {{"model", "'other'"},
                             {"type", "'other'"},
                             {"see", "['ball', 'lines']"},
                             {"period_s", "0.7"},
                             {"fov_deg", "100"},
                             {"max_range_m", "2"},
                             {"min_range_m", "1.5"},
                             {"occlusion", "false"},
                             {"slack_m", "0"},
                             {"visible_share", "0.95"},
                             {"noise_range_sigma_m", "0.5"},
                             {"noise_range_sigma_per_m", "0.3"},
                             {"noise_bearing_sigma_deg", "9"},
                             {"missed_share", "0.4"},
                             {"false_share", "0.4"},
                             {"pose.z_m", "1.6"},
                             {"lines.rays", "11"},
                             {"lines.max_range_m", "1.5"},
                             {"lines.cell_m", "0.3"},
                             {"lines.used_points", "2"},
                             {"lines.sigma_m", "0.5"},
                             {"lines.sigma_per_m", "0.4"},
                             {"lines.outliers", "0.3"},
                             {"lines.exponent", "0.9"}};
  for (const std::string kind : {"goals.", "posts."}) {
    const Settings alike{{kind + "identified", "false"}};
    all.push_back({kind + "identified", "false"});
    all.push_back({kind + "max_range_m", "2"});
    all.push_back({kind + "identities", kind == "goals." ? "[2]" : "[1]"});
    all.push_back({kind + "range_sigma_m", "0.5"});
    all.push_back({kind + "range_sigma_per_m", "0.4"});
    all.push_back({kind + "bearing_sigma_deg", "9"});
    all.push_back({kind + "outliers", "0.3"});
    all.push_back({kind + "exponent", "0.5"});
    all.push_back({kind + "sigma_m", "0.5", alike});
    all.push_back({kind + "sigma_per_m", "0.4", alike});
  }
  return all;
}

const std::set<std::string> kOfCamerasWithout = {"pose",
                                                 "lines",
                                                 "goals",
                                                 "posts",
                                                 "feature",
                                                 "lines.max_range_mass",
                                                 "goals.max_range_mass",
                                                 "posts.max_range_mass"};

TEST(SettingsEffect, OfCameras) {
  for (const char* plugin : {"iconic_omnivision", "iconic_camera"})
    expectSensorEffects(plugin, {{"lines.rays", "21"}, {"fov_deg", "300"}}, ofCameras(),
                        {"", "lines.", "goals.", "posts."}, kOfCamerasWithout);
}

TEST(SettingsEffect, OfTheLaserThatSaysWhatItSees) {
  const Settings around{{"beams", "120"}, {"fov_deg", "360"}};
  expectSensorEffects("lrf_iconic", around,
                      {{"model", "'other'"},         {"type", "'other'"},
                       {"period_s", "0.7"},          {"beams", "60"},
                       {"fov_deg", "200"},           {"first_angle_deg", "-100"},
                       {"max_range_m", "2"},         {"min_range_m", "1"},
                       {"range_sigma_m", "0.2"},     {"range_sigma_per_m", "0.2"},
                       {"wall_sigma_m", "0.2"},      {"break_m", "2"},
                       {"line_tolerance_m", "0.4"},  {"shortest_line_m", "2.5"},
                       {"largest_round_m", "0.1"},   {"share_matched", "0.98"},
                       {"most_positions", "1"},      {"sigma_m", "0.5"},
                       {"sigma_deg", "20"},          {"outliers", "0.3"},
                       {"exponent", "0.5"},          {"noise_sigma_m", "0.1"},
                       {"noise_sigma_per_m", "0.1"}, {"dropout_share", "0.3"},
                       {"pose.z_m", "0.9"}},
                      {""}, {"pose", "reads", "feature", "angle_step_deg"});
}

TEST(SettingsEffect, OfWhatTheRobotKnowsOfItself) {
  for (const char* plugin : {"odometry", "ground_truth"})
    expectEffects(plugin, {}, together(names(), {{"period_s", "0.7"}}), {""}, {},
                  [&](const std::string& settings) {
                    SensorRig rig(plugin, settings);
                    return toText(rig.data[0]->id()) + std::to_string(rig.sensor->period());
                  });
}

/// All that a drive tells and does: limits, ways, odometry.
std::string drives(const std::string& plugin, const std::string& settings) {
  const auto drive = makeDrive(plugin, settings);
  std::string text;
  const DriveLimits limits = drive->limits();
  for (const double limit :
       {limits.speed, limits.turn, limits.acceleration, limits.turnAcceleration})
    add(text, limit);
  Random slip(3);
  Random noise(5);
  for (int i = 0; i < 200; ++i) {
    if (i % 50 == 0) {
      drive->setTranslationalVelocity(i < 100 ? 5.0 : 0.1);
      drive->setRotationalVelocity(i == 50 ? 9.0 : 0.2);
    }
    if (i == 170 && drive->commandSize() == 3) drive->setCommand(std::array{0.2, -0.1, 0.4});
    if (i == 170 && drive->commandSize() == 2) drive->setCommand(std::array{0.2, 0.3});
    const Pose2 change = drive->relocate(0.02, &slip);
    const Pose2 seen = drive->measure(change, &noise);
    for (const double v : {change.x, change.y, change.theta, seen.x, seen.y, seen.theta})
      add(text, v);
    add(text, drive->measuredVelocity(true).x);
    add(text, drive->measuredVelocity(true).theta);
  }
  return text;
}

std::vector<Change> ofOdometry() {
  return {{"odometry_distance_sigma_m", "0.2"},
          {"odometry_heading_sigma_deg", "9"},
          {"odometry_turn_sigma_deg", "30"},
          {"odometry_distance_scale", "1.1"},
          {"odometry_turn_scale", "0.9"}};
}

TEST(SettingsEffect, OfDrives) {
  const auto expect = [](const std::string& plugin, const Settings& base,
                         const std::vector<Change>& own) {
    expectEffects(plugin, base, together(ofOdometry(), own), {""}, {"plugin", "body_height_m"},
                  [&](const std::string& settings) { return drives(plugin, settings); });
  };
  expect("differential", {},
         {{"max_speed_m_s", "0.4"},
          {"max_turn_deg_s", "60"},
          {"acceleration_m_s2", "0.3"},
          {"turn_acceleration_deg_s2", "50"},
          {"axle_m", "0.6"},
          {"max_wheel_speed_m_s", "0.3"},
          {"slip_share", "0.2"},
          {"slip_sigma_m", "0.1"},
          {"encoder_ticks_per_m", "50"},
          {"encoder_sigma_m", "0.1"}});
  expect("omni", {},
         {{"wheel_angles_deg", "[50, 180, 310]"},
          {"wheel_distance_m", "0.3"},
          {"max_wheel_speed_m_s", "0.3"},
          {"wheel_acceleration_m_s2", "0.2"},
          {"max_speed_m_s", "0.2"},
          {"max_turn_deg_s", "30"}});
}

/// Samples moved, and where odometry has been.
std::string moves(const std::string& plugin, const std::string& settings) {
  const auto motion = makeMotion(plugin, settings);
  std::vector<float> x(64, 0.0F), y(64, 0.0F), theta(64, 0.0F);
  for (const Pose2& change : {Pose2{0.3, 0.1, 0.2}, Pose2{0.0, 0.0, -0.5}, Pose2{-0.2, 0.0, 0.0}})
    motion->sampleMotion({x, y, theta}, change, 3, 4, 0);
  std::string text;
  for (const auto* all : {&x, &y, &theta})
    for (const float v : *all) add(text, static_cast<double>(v));
  for (int i = 0; i <= 20; ++i) motion->follow(i * 50'000, {{0.02 * i, 0, 0.01 * i}, 0.4, 0.2, {}});
  if (const auto pose = motion->odometryAt(700'000)) add(text, pose->x);
  return text;
}

TEST(SettingsEffect, OfMotionModels) {
  for (const char* plugin : {"odometry", "differential", "omni"})
    expectEffects(plugin, {},
                  {{"turn_per_turn", "0.4"},
                   {"turn_per_m", "0.4"},
                   {"way_per_m", "0.4"},
                   {"way_per_turn", "0.4"},
                   {"floor_m", "0.1"},
                   {"floor_deg", "5"},
                   {"slip_share", "0.3"},
                   {"way_scale", "1.1"},
                   {"turn_scale", "1.1"},
                   {"turn_bias_deg_per_m", "20"},
                   {"way_bias_m_per_rad", "0.2"},
                   {"delay_s", "0.2"}},
                  {""}, {"plugin"},
                  [&](const std::string& settings) { return moves(plugin, settings); });
}

}  // namespace
}  // namespace ortung

// Limits of all numbers in world, scene and robot files: the limit itself is taken, what is a
// little beyond it is refused, with the key's name.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "WorldFiles.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim/Scene.hpp"

namespace ortung::test {
namespace {

constexpr std::optional<double> kNone;

struct Limit {
  std::string key;
  std::string text;  ///< of a file, with @ where the number stands
  std::optional<double> low;
  std::optional<double> high;
  bool isWhole = false;
};

std::string with(const Limit& limit, double value) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), limit.isWhole ? "%.0f" : "%.17g", value);
  std::string text = limit.text;
  return text.replace(text.find('@'), 1, digits.data());
}

/// What is wrong, or "".
template <class Action>
std::string complaintOf(const Action& read) {
  try {
    read();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

/// @param refusal gives what is said about a file's text, "" if it is taken
template <class Refusal>
void expectLimits(const std::vector<Limit>& limits, const Refusal& refusal) {
  for (const Limit& limit : limits) {
    const auto look = [&](double value, double beyond) {
      const std::string fine = with(limit, value);
      EXPECT_EQ(refusal(fine), "") << fine;
      const std::string wrong = with(limit, value + beyond);
      const std::string said = refusal(wrong);
      EXPECT_NE(said.find(limit.key + " "), said.npos) << wrong << "\n" << said;
    };
    const auto little = [&](double value) {
      return limit.isWhole ? 1.0 : std::max(1e-9, 1e-9 * std::abs(value));
    };
    if (limit.low) look(*limit.low, -little(*limit.low));
    if (limit.high) look(*limit.high, little(*limit.high));
  }
}

TEST(FileLimits, OfWorlds) {
  const std::string box = "[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [1, 2]\n";
  const std::string ring = "[[ellipse]]\nkind = \"line\"\ncenter_m = [3, 0]\nsize_m = [1, 2]\n";
  const std::string ball = "[[ellipse]]\nkind = \"ball\"\ncenter_m = [1, 0]\nsize_m = [0.2, 0.2]\n";
  const std::string mark = "[[landmark]]\nkind = \"tag\"\n";
  expectLimits(
      {
          {"center_m", "[[rectangle]]\ncenter_m = [@, 0]\nsize_m = [1, 2]\n", -1e4, 1e4},
          {"center_m", "[[ellipse]]\ncenter_m = [0, @]\nsize_m = [1, 2]\n", -1e4, 1e4},
          {"size_m", "[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [@, 2]\n", 0.001, 2e4},
          {"size_m", "[[ellipse]]\ncenter_m = [3, 0]\nsize_m = [1, @]\n", 0.001, 2e4},
          {"corners_m", "[[triangle]]\ncorners_m = [0, 0, 1, 0, 0, @]\n", -1e4, 1e4},
          {"angle_deg", box + "angle_deg = @\n", -3600.0, 3600.0},
          {"z_m", box + "z_m = [@, 1]\n", -100.0, 0.999},
          {"z_m", box + "z_m = [0, @]\n", 0.001, 1000.0},
          {"friction", box + "friction = @\n", 0.0, 10.0},
          {"restitution", box + "restitution = @\n", 0.0, 1.0},
          {"mass_kg", box + "movable = true\nmass_kg = @\n" + box, 0.001, 1e5},
          {"mass_kg", ball + "mass_kg = @\n" + box, 0.001, 1e5},
          {"identity", box + "identity = @\n", 0.0, 4294967295.0, true},
          {"stroke_m", ring + "stroke_m = @\n", 0.0, 10.0},
          {"arc_deg", ring + "arc_deg = [@, -90]\n", -360.0, kNone},
          {"arc_deg", ring + "arc_deg = [450, @]\n", kNone, 720.0},
          {"arc_deg", ring + "arc_deg = [-180, @]\n", kNone, 180.0},  // a whole turn
          {"identity", mark + "position_m = [0, 0]\nidentity = @\n" + box, 0.0, 4294967295.0, true},
          {"position_m", mark + "identity = 1\nposition_m = [@, 0]\n" + box, -1e4, 1e4},
          {"position_m", mark + "identity = 1\nposition_m = [0, 0, @]\n" + box, -1e4, 1e4},
          {"x_m", box + "[world]\nx_m = [@, 5]\n", -1e4, 4.999},
          {"x_m", box + "[world]\nx_m = [-5, @]\n", -4.999, 1e4},
          {"y_m", box + "[world]\ny_m = [@, 5]\n", -1e4, 4.999},
          {"y_m", box + "[world]\ny_m = [-5, @]\n", -4.999, 1e4},
          {"cycle_ms", box + "[physics]\ncycle_ms = @\n", 0.1, 1000.0},
          {"friction", box + "[physics]\nfriction = @\n", 0.0, 10.0},
          {"restitution", box + "[physics]\nrestitution = @\n", 0.0, 1.0},
          {"floor_friction", box + "[physics]\nfloor_friction = @\n", 0.0, 10.0},
          {"rolling_resistance", box + "[physics]\nrolling_resistance = @\n", 0.0, 1.0},
      },
      [](const std::string& text) { return refusalOf(text); });
}

TEST(FileLimits, OfGridsInWorlds) {
  const TemporaryFolder folder;
  folder.write("map.pgm", pgmOf({"..#", "..."}));
  folder.write("map.yaml", mapYaml());
  expectLimits(
      {
          {"unknown_margin_m", gridWorld("map.yaml", "unknown_margin_m = @\n"), 0.0, 100.0},
          {"surface_depth_cells", gridWorld("map.yaml", "surface_depth_cells = @\n"), 0.0, 1.0},
          {"map_error_m", gridWorld("map.yaml", "map_error_m = @\n"), 0.0, 1.0},
          {"z_m", gridWorld("map.yaml", "z_m = [@, 1]\n"), -100.0, 0.999},
          {"z_m", gridWorld("map.yaml", "z_m = [0, @]\n"), 0.001, 1000.0},
      },
      [&](const std::string& text) { return refusalOf(folder.write("world.toml", text)); });
}

TEST(FileLimits, OfScenes) {
  const std::string head = "[scene]\nworld = \"w.toml\"\n";
  const std::string robot = "[[robot]]\nfile = \"r.toml\"\nname = \"one\"\n";
  const std::string command = head + robot + "[[command]]\nrobot = \"one\"\n";
  const std::string thing = head + robot + "[[thing]]\nname = \"ball\"\n";
  const std::string here = "pose = { x_m = 0, y_m = 0 }\n";
  const TemporaryFolder folder;
  expectLimits(
      {
          {"duration_s", head + "duration_s = @\n" + robot, 0.0, 1e6},
          {"x_m", head + robot + "start = { x_m = @, y_m = 0 }\n", -1e4, 1e4},
          {"y_m", head + robot + "start = { x_m = 0, y_m = @ }\n", -1e4, 1e4},
          {"theta_deg", head + robot + "start = { x_m = 0, y_m = 0, theta_deg = @ }\n", -3600.0,
           3600.0},
          {"waypoints_m", head + robot + "waypoints_m = [1, 1, 0, @]\n", -1e4, 1e4},
          {"speed_m_s", head + robot + "speed_m_s = @\n", 0.0, 100.0},
          {"kidnap_s", head + robot + "kidnap_s = [@]\n", 0.0, 1e6},
          {"at_s", command + "at_s = @\n", 0.0, 1e6},
          {"translational_m_s", command + "at_s = 1\ntranslational_m_s = @\n", -100.0, 100.0},
          {"rotational_deg_s", command + "at_s = 1\nrotational_deg_s = @\n", -36000.0, 36000.0},
          {"command", command + "at_s = 1\ncommand = [0, @]\n", -1e6, 1e6},
          {"at_s", thing + here + "at_s = @\n", 0.0, 1e6},
          {"x_m", thing + "pose = { x_m = @, y_m = 0 }\n", -1e4, 1e4},
          {"velocity_m_s", thing + here + "velocity_m_s = [0, @]\n", -100.0, 100.0},
          {"rotational_deg_s", thing + here + "rotational_deg_s = @\n", -36000.0, 36000.0},
      },
      [&](const std::string& text) {
        return complaintOf([&] { Scene::read(folder.write("scene.toml", text)); });
      });
}

TEST(FileLimits, OfRobotsInTheSimulator) {
  const std::string sensor = "[[sensor]]\nplugin = \"odometry\"\n";
  const std::string piece = "[[body]]\ncenter_m = [0, 0]\nsize_m = [0.4, 0.3]\n";
  const std::string state =
      "[[manipulator]]\nname = \"arm\"\n[[manipulator.state]]\nname = \"in\"\n"
      "[[manipulator.state]]\nname = \"out\"\n";
  const std::string reach =
      "[[manipulator.state.body]]\ncenter_m = [0.3, 0]\nsize_m = [0.1, 0.1]\n";
  expectLimits(
      {
          {"radius_m", "[robot]\nradius_m = @\n", 0.001, 100.0},
          {"mass_kg", "[robot]\nmass_kg = @\n", 0.01, 1e5},
          {"body_height_m", "[drive]\nbody_height_m = @\n", 0.01, 10.0},
          {"center_m", "[[body]]\ncenter_m = [@, 0]\nsize_m = [1, 1]\n", -1e4, 1e4},
          {"size_m", "[[body]]\ncenter_m = [0, 0]\nsize_m = [@, 1]\n", 0.001, 2e4},
          {"z_m", piece + "z_m = [@, 1]\n", -100.0, 0.999},
          {"z_m", piece + "z_m = [0, @]\n", 0.001, 1000.0},
          {"angle_deg", piece + "angle_deg = @\n", -3600.0, 3600.0},
          {"friction", piece + "friction = @\n", 0.0, 10.0},
          {"restitution", piece + "restitution = @\n", 0.0, 1.0},
          {"ball_speed_m_s", state + "ball_speed_m_s = @\n" + reach, 0.0, 50.0},
          {"direction_deg", state + "direction_deg = @\n", -360.0, 360.0},
          {"returns_after_s", state + "returns_after_s = @\n", 0.0, 3600.0},
      },
      [&](const std::string& text) {
        return complaintOf(
            [&] { RobotShape::read(readRobot(parseToml(sensor + text, "robot.toml"))); });
      });
}

/// @param most tables of a kind are taken, one more is refused
template <class Table, class Refusal>
void expectMost(std::size_t most, const std::string& part, const Table& table,
                const Refusal& refusal) {
  std::string text;
  for (std::size_t i = 0; i < most; ++i) text += table(std::to_string(i));
  EXPECT_EQ(refusal(text), "") << most;
  const std::string said = refusal(text + table(std::to_string(most)));
  EXPECT_NE(said.find(part), said.npos) << most << ": " << said;
}

TEST(FileLimits, OfHowManyTablesThereAre) {
  const TemporaryFolder folder;
  folder.write("map.pgm", pgmOf({"..#", "..."}));
  folder.write("map.yaml", mapYaml());
  const auto world = [&](const std::string& text) {
    return refusalOf(folder.write("world.toml", gridWorld("map.yaml", "") + text));
  };
  expectMost(
      15, "there are 17, expected at most 16",  // beside the first
      [](const std::string&) { return gridWorld("map.yaml", ""); }, world);
  expectMost(
      256, "257 primitives are movable, expected at most 256",
      [](const std::string& i) {
        return "[[ellipse]]\nkind = \"ball\"\ncenter_m = [" + i + ", 0]\nsize_m = [0.2, 0.2]\n";
      },
      world);
  expectMost(
      256, "there are 257, expected at most 256",
      [](const std::string& i) { return "[[robot]]\nfile = \"r.toml\"\nname = \"r" + i + "\"\n"; },
      [&](const std::string& text) {
        return complaintOf([&] {
          Scene::read(folder.write("scene.toml", "[scene]\nworld = \"w.toml\"\n" + text));
        });
      });
}

TEST(FileLimits, OfHowManyPartsARobotHas) {
  const auto robot = [](const std::string& text) {
    return complaintOf([&] {
      RobotShape::read(
          readRobot(parseToml("[[sensor]]\nplugin = \"odometry\"\n" + text, "robot.toml")));
    });
  };
  const auto piece = [](const std::string& list, const std::string& shape) {
    return "[[" + list + "]]\nshape = \"" + shape + "\"\ncenter_m = [0, 0]\nsize_m = [0.4, 0.3]\n";
  };
  const auto arm = [](const std::string& i) {
    return "[[manipulator]]\nname = \"arm" + i + "\"\n[[manipulator.state]]\nname = \"in\"\n";
  };
  expectMost(
      64, "is one too many, expected at most 64",
      [&](const std::string&) { return piece("body", "rectangle"); }, robot);
  expectMost(
      16, "of 136 pieces (an ellipse counts 8), expected at most 128",
      [&](const std::string&) { return piece("body", "ellipse"); }, robot);
  expectMost(16, "expected at most 16 manipulators", arm, robot);
  expectMost(
      15, "is there 17 times, expected 1 to 16",
      [](const std::string& i) { return "[[manipulator.state]]\nname = \"s" + i + "\"\n"; },
      [&](const std::string& text) { return robot(arm("") + text); });
  // Of a manipulator's states, that with the most pieces counts; one more is the robot itself.
  expectMost(
      15, "brings the robot to 129 pieces at a time (an ellipse counts 8), expected at most 128",
      [&](const std::string&) { return piece("manipulator.state.body", "ellipse"); },
      [&](const std::string& text) {
        return robot(arm("") + "[[manipulator.state]]\nname = \"out\"\n" + text);
      });
}

}  // namespace
}  // namespace ortung::test

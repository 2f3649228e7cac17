// What clients learn of a world and its robots: enough to place, to drive, and to compute with.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "Files.hpp"
#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

constexpr const char* kWorld = R"(
[world]
name = "two rooms"
x_m = [-3, 4.25]
y_m = [-1.5, 2]
[[rectangle]]
center_m = [3.9, -1.2]
size_m = [0.2, 0.2]
z_m = [0, 1]
)";

std::string ball(const std::string& name, double x) {
  return "[[ellipse]]\nkind = \"ball\"\n" + (name.empty() ? "" : "name = \"" + name + "\"\n") +
         "center_m = [" + std::to_string(x) +
         ", 0]\nsize_m = [0.2, 0.2]\nz_m = [0, 0.2]\nmass_kg = 0.4\n";
}

std::vector<std::string> linesOf(TestClient& client, const std::string& request) {
  std::vector<std::string> lines;
  const std::string count = valueOf(client.ask(request), "lines");
  for (int i = count.empty() ? 0 : std::stoi(count); i > 0; --i) lines.push_back(client.line());
  return lines;
}

TEST(Describe, EveryMovableThingHasAWordByWhichItCanBePlaced) {
  const TemporaryFolder folder;
  writeBytes(folder / "w.toml", kWorld + ball("the red ball", 0) + ball("the red ball", 1) +
                                    ball("", 2) + ball("the_red_ball", 3) + ball("", -1));
  ServedSimulation world(folder / "w.toml", {.noise = false});
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  const std::vector<std::string> lines = linesOf(client, "DESCRIBE world");
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0],
            "world=two_rooms kind=simulation fingerprint=" + world.describe().fingerprint +
                " x_min_m=-3 y_min_m=-1.5 x_max_m=4.25 y_max_m=2");
  const std::vector<std::string> names = {"the_red_ball", "the_red_ball-2", "ball",
                                          "the_red_ball-3", "ball-2"};
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(lines[i + 1], "object=" + names[i] + " kind=ball radius_m=0.1 height_m=0.2");
  // Each one can be put where another one was, once that has left: they are five different ones.
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string place = " x_m=" + std::to_string(-2.0 + static_cast<double>(i)) + " y_m=1.5";
    EXPECT_EQ(client.ask("PLACE object=" + names[i] + place), "OK PLACE");
    EXPECT_TRUE(client.ask("PLACE object=" + names[(i + 1) % names.size()] + place)
                    .starts_with("ERR no-room"));
  }
  EXPECT_EQ(client.ask("PLACE object=crate x_m=0 y_m=0"),
            "ERR no-object this world has no movable object 'crate'; DESCRIBE world lists them");
}

TEST(Describe, ARobotTellsWhereItsSensorsAreAndWhatItsDriveCanDo) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  ASSERT_TRUE(
      client
          .join("[robot]\nradius_m = 0.21\nmass_kg = 12.5\n[drive]\nmax_speed_m_s = 1.25\n"
                "max_turn_deg_s = 90\nacceleration_m_s2 = 0.5\n"
                "turn_acceleration_deg_s2 = 180\nbody_height_m = 0.45\n"
                "[[sensor]]\nplugin = \"lrf\"\nmodel = \"A\"\ntype = \"B\"\nfeature = \"C\"\n"
                "pose = { x_m = 0.125, y_m = -0.25, z_m = 0.3, theta_deg = 30 }\n")
          .starts_with("OK CREATE"));
  const std::vector<std::string> lines = linesOf(client, "DESCRIBE robot");
  const auto line = [&](const std::string& beginning) {
    for (const std::string& one : lines)
      if (one.starts_with(beginning)) return one;
    return "no line " + beginning;
  };
  EXPECT_NE(line("A/B/C ").find("mm"), std::string::npos);
  const std::string mount = line("mount A/B/C ");
  EXPECT_EQ(valueOf(mount, "x_m"), "0.125");
  EXPECT_EQ(valueOf(mount, "y_m"), "-0.25");
  EXPECT_NEAR(std::stod(valueOf(mount, "theta_rad")), std::numbers::pi / 6, 1e-12);
  EXPECT_EQ(line("mount reference/groundTruth/pose"),
            "mount reference/groundTruth/pose x_m=0 y_m=0 theta_rad=0");
  const std::string limits = line("limits ");
  EXPECT_EQ(valueOf(limits, "v_m_s"), "1.25");
  EXPECT_NEAR(std::stod(valueOf(limits, "w_rad_s")), std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(valueOf(limits, "a_m_s2"), "0.5");
  EXPECT_NEAR(std::stod(valueOf(limits, "alpha_rad_s2")), std::numbers::pi, 1e-12);
  EXPECT_EQ(line("body "), "body radius_m=0.21 height_m=0.45 mass_kg=12.5");
  EXPECT_EQ(line("drive ").substr(0, 6), "drive ");
  EXPECT_EQ(line("motion "), "motion kind=differential numbers=2");
  EXPECT_TRUE(line("format A/B/C ").starts_with("format A/B/C scan beams=180 first_deg=-"));
  EXPECT_EQ(line("format reference/groundTruth/pose"), "format reference/groundTruth/pose pose");
}

/// The corners of a line "outline ...".
std::vector<Point2> cornersIn(const std::string& line) {
  std::vector<Point2> corners;
  std::istringstream words(line);
  for (std::string word; words >> word;)
    if (const std::size_t comma = word.find(','); comma != word.npos)
      corners.push_back({std::stod(word.substr(0, comma)), std::stod(word.substr(comma + 1))});
  return corners;
}

/// Twice the area that corners enclose, by the shoelace formula: above 0 if they go round to the
/// left.
double twiceTheArea(const std::vector<Point2>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& a = corners[i];
    const Point2& b = corners[(i + 1) % corners.size()];
    sum += a.x * b.y - b.x * a.y;
  }
  return sum;
}

TEST(Describe, ARobotsPiecesAreOutlinedCornerByCorner) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  const std::string reply = client.join(
      "[robot]\nradius_m = 0.4\n[[sensor]]\nplugin = \"odometry\"\n"
      "[[body]]\nshape = \"ellipse\"\ncenter_m = [0.05, -0.1]\nsize_m = [0.4, 0.2]\n"
      "angle_deg = 30\nz_m = [0.1, 0.3]\n"
      "[[body]]\nshape = \"rectangle\"\ncenter_m = [0.1, 0.2]\nsize_m = [0.2, 0.1]\n"
      "angle_deg = 90\nz_m = [0, 0.25]\n"
      "[[manipulator]]\nname = \"arm\"\n[[manipulator.state]]\nname = \"in\"\n"
      "[[manipulator.state]]\nname = \"out\"\n[[manipulator.state.body]]\nshape = "
      "\"triangle\"\ncorners_m = [0.2, 0.0, 0.3, 0.1, 0.2, 0.1]\nz_m = [0, 0.125]\n");
  ASSERT_TRUE(reply.starts_with("OK CREATE")) << reply;
  std::vector<std::string> outlines;
  for (const std::string& line : linesOf(client, "DESCRIBE robot"))
    if (line.starts_with("outline")) outlines.push_back(line);
  ASSERT_EQ(outlines.size(), 3u) << "the arm has nothing when it is in";

  EXPECT_TRUE(outlines[0].starts_with("outline z0_m=0.1 z1_m=0.3 ")) << outlines[0];
  const std::vector<Point2> ellipse = cornersIn(outlines[0]);
  constexpr double kTurned = std::numbers::pi / 6.0;
  for (std::size_t i = 0; i < ellipse.size(); ++i) {
    const double dx = ellipse[i].x - 0.05;
    const double dy = ellipse[i].y + 0.1;
    const double along = (dx * std::cos(kTurned) + dy * std::sin(kTurned)) / 0.2;
    const double across = (dy * std::cos(kTurned) - dx * std::sin(kTurned)) / 0.1;
    EXPECT_NEAR(std::hypot(along, across), 1.0, 0.001) << "corner " << i << ", to 0.1 mm";
    const Point2& next = ellipse[(i + 1) % ellipse.size()];
    EXPECT_GT(std::hypot(next.x - ellipse[i].x, next.y - ellipse[i].y), 0.01) << "none is twice";
  }
  EXPECT_GT(twiceTheArea(ellipse), 2.0 * 0.98 * std::numbers::pi * 0.2 * 0.1) << "once around";
  EXPECT_LT(twiceTheArea(ellipse), 2.0 * std::numbers::pi * 0.2 * 0.1);

  EXPECT_TRUE(outlines[1].starts_with("outline z0_m=0 z1_m=0.25 ")) << outlines[1];
  const std::vector<Point2> rectangle = cornersIn(outlines[1]);
  ASSERT_EQ(rectangle.size(), 4u);
  EXPECT_NEAR(std::abs(twiceTheArea(rectangle)), 2.0 * 0.2 * 0.1, 1e-9);
  for (const Point2& corner : rectangle) {  // turned, it is 0.1 wide and 0.2 deep
    EXPECT_NEAR(std::abs(corner.x - 0.1), 0.05, 1e-9);
    EXPECT_NEAR(std::abs(corner.y - 0.2), 0.1, 1e-9);
  }

  EXPECT_TRUE(outlines[2].starts_with("outline manipulator=arm state=out z0_m=0 z1_m=0.125 "))
      << outlines[2];
  EXPECT_EQ(cornersIn(outlines[2]).size(), 3u);
  EXPECT_NEAR(std::abs(twiceTheArea(cornersIn(outlines[2]))), 0.1 * 0.1, 1e-9);
}

TEST(Describe, ARobotThatIsTrackedByANetworkCanJoin) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  const std::string motion = "[motion]\nplugin = \"neural\"\nnetwork_file = \"/etc/passwd\"\n";
  EXPECT_TRUE(client.join(motion + "[[sensor]]\nplugin = \"odometry\"\n").starts_with("OK CREATE"));
  client.send(
      "CREATE other\n[drive]\nplugin = \"neural\"\nnetwork_file = \"net.json\"\n"
      "[[sensor]]\nplugin = \"odometry\"\n");
  EXPECT_EQ(client.ask("."),
            "ERR configuration robot file:3: network_file names a file, which a configuration from "
            "the network must not");
}

}  // namespace
}  // namespace ortung::test

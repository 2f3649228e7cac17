// The figures that `ortung check` prints, counted here by themselves.
#include <cmath>
#include <regex>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

class CheckedFigures : public Workspace {
 protected:
  static void expectParts(const Outcome& outcome, const std::vector<std::string>& parts) {
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
  }
};

struct Box {
  double x, y, halfX, halfY;
  double distance(double px, double py) const {
    return std::hypot(std::max(0.0, std::abs(px - x) - halfX),
                      std::max(0.0, std::abs(py - y) - halfY));
  }
};

/// Cells of 0.1 m of the hall from whose middle it is that far to both boxes and to the walls.
int cellsWithRoom(double room) {
  const Box boxes[] = {{-2.2, 1.4, 0.5, 0.3}, {2.4, -1.0, 0.2, 0.6}};
  int count = 0;
  for (double x = -2.95; x < 3.0; x += 0.1) {
    for (double y = -1.95; y < 2.0; y += 0.1) {
      if (std::abs(x) + room > 3.0 + 1e-9 || std::abs(y) + room > 2.0 + 1e-9) continue;
      bool isFree = true;
      for (const Box& box : boxes) isFree = isFree && box.distance(x, y) >= room - 1e-9;
      for (const Box& box : boxes) isFree = isFree && box.distance(x, y) > 0.0;
      count += isFree ? 1 : 0;
    }
  }
  return count;
}

TEST_F(CheckedFigures, OfAWorldAreItsCellsAndWhereARobotFits) {
  ASSERT_EQ(cellsWithRoom(0.0), 2400 - 60 - 48);
  const std::string open = ", " + std::to_string(cellsWithRoom(0.0)) + " open, ";
  expectParts(
      ortung({"check", path("hall.toml"), "--robot", path("robot.toml")}),
      {"world 'hall', fingerprint ", "\n  x -3 to 3 m, y -2 to 2 m\n  60 x 40 cells of 0.1 m",
       open + std::to_string(cellsWithRoom(0.2)) +
           " where a robot of radius 0.2 m and height 0.5 m can stand\n",
       "\n  no landmarks\n"});
  // Without a robot file, of one of its default radius; some middles are just that far from walls.
  expectParts(ortung({"check", path("hall.toml")}), {open, " where a robot of radius 0.25 m"});
}

TEST_F(CheckedFigures, OfLandmarksAreHowManyOfEachKind) {
  std::string world = read("hall.toml");
  for (int i = 1; i <= 5; ++i)
    world += std::string("[[landmark]]\nkind = \"") + (i < 3 ? "post" : "lamp") +
             "\"\nidentity = " + std::to_string(i) + "\nposition_m = [" + std::to_string(0.3 * i) +
             ", 0, 1]\n";
  write("hall.toml", world);
  expectParts(ortung({"check", path("hall.toml")}), {"\n  landmarks: 3 lamp, 2 post\n"});
}

// A wall of 0.1 m from one side of the hall to the other, 2 m from its left end: 2 m x 4 m, but
// for the box there and the robot's radius, are cut off.
TEST_F(CheckedFigures, OfADividedWorldSayHowMuchIsCutOff) {
  write("hall.toml",
        read("hall.toml") +
            "[[rectangle]]\nkind = \"wall\"\ncenter_m = [-0.95, 0]\nsize_m = [0.1, 4]\n");
  const Outcome outcome = ortung({"check", path("hall.toml"), "--robot", path("robot.toml")});
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      outcome.out, found,
      std::regex("\n  ([0-9.]+) m\\^2 of that are separated by walls from the robot's area\n")))
      << outcome.out;
  // 1.6 m x 3.6 m without the box of 0.8 m x 0.7 m and a quarter of a circle at its corner.
  const double corner = 0.2 * 0.2 * (1 - std::acos(-1.0) / 4);
  EXPECT_NEAR(std::stod(found[1]), 1.6 * 3.6 - (1.5 - 0.2) * (0.7 + 0.2 + 0.3 - 0.2) + corner, 0.3);
}

TEST_F(CheckedFigures, OfARobotAreItsFeaturesAndHowItIsSimulated) {
  expectParts(ortung({"check", path("robot.toml")}),
              {"robot 'scout', radius 0.2 m, 3 sensors, 3 features\n",
               "\n  drive 'differential', commands ", "; 10 kg, 1 pieces, 0 manipulators\n",
               "\n  motion 'odometry'\n", "\n  sensor 'lrf', at x ",
               "\n    LMS200/LRF/180DegreeScan                 localizes\n",
               "\n  1 of 3 features localize; "});
  expectParts(ortung({"check", path("robot.toml"), "--wire"}),
              {"robot 'scout', radius 0.2 m, 3 sensors, 3 features\n",
               "\n  LMS200/LRF/180DegreeScan                 localizes; ",
               "\n                                           format "});
}

TEST_F(CheckedFigures, OfASceneAreItsRobotsAndCommands) {
  write("scene.toml",
        "[scene]\nworld = \"hall.toml\"\nduration_s = 3\n[[robot]]\nfile = \"robot.toml\"\nname = "
        "\"anna\"\nstart = { x_m = 0, y_m = 0, theta_deg = 0 }\n[[robot]]\nfile = "
        "\"robot.toml\"\nname = \"bert\"\nstart = { x_m = 1, y_m = 1, theta_deg = 0 }\n");
  expectParts(ortung({"check", path("scene.toml")}),
              {"scene.toml: scene in the world 'hall', 2 robots, 0 commands\n"});
}

TEST_F(CheckedFigures, OfTablesAreThoseWithWhichTheyWereLearned) {
  learnTables();
  expectParts(ortung({"check", path("hall.ortung")}),
              {"tables of robot 'scout' in world 'hall', fingerprint ",
               "\n  x -3 to 3 m, y -2 to 2 m\n  60 x 40 cells of 0.1 m, " +
                   std::to_string(cellsWithRoom(0.0)) + " open, " +
                   std::to_string(cellsWithRoom(0.2)) + " standable; directions every 4 degrees\n",
               "\n  LMS200/LRF/180DegreeScan "});
}

TEST_F(CheckedFigures, OfARecordAreItsReadingsAndTime) {
  write("run.rec",
        "# ortung record 1\n1500000 a/b/c 1 7\n1500000 a/b/d 0\n2000000 a/b/c 1 8\n4750000 a/b/c 1 "
        "9\n");
  expectParts(ortung({"check", path("run.rec")}),
              {"run.rec: record, world not known, 4 readings, 1500000 to 4750000 us (3.250 s)\n"
               "  a/b/c                                            3 readings\n"
               "  a/b/d                                            1 readings\n"});
  ASSERT_EQ(ortung({"import", "record", path("run.rec"), "--out", path("small.rec")}).exitCode, 0);
  expectParts(ortung({"check", path("small.rec")}), {"small.rec: record, compressed, world not "});
}

TEST_F(CheckedFigures, OfARecordForARobotNameWhatItLacksAndWhatItCanNotRead) {
  write("run.rec", "# ortung record 1\n0 sonar/sonar/ring 1 7\n10 odometry/odometry/pose 1 2\n");
  expectParts(ortung({"check", path("run.rec")}), {"sonar/sonar/ring"});
  expectRefused(
      ortung({"check", path("run.rec"), "--robot", path("robot.toml")}), 1,
      "ortung check: " + path("run.rec") + ": reading at 10 us: ", {"odometry/odometry/pose"});
  write("run.rec", "# ortung record 1\n0 sonar/sonar/ring 1 7\n");
  expectParts(ortung({"check", path("run.rec"), "--robot", path("robot.toml")}),
              {"\n  sonar/sonar/ring                                 1 readings, not in the robot "
               "file\n"});
}

TEST_F(CheckedFigures, OfSeveralFilesEndWithHowManyAreBad) {
  EXPECT_EQ(ortung({"check", path("hall.toml")}).out.find("files"), std::string::npos);
  const Outcome outcome = ortung({"check", path("none.toml"), path("hall.toml"), folder_.string()});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_TRUE(outcome.out.ends_with("\n3 files, 2 bad\n")) << outcome.out;
}

}  // namespace
}  // namespace ortung::test

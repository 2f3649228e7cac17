// `ortung calibrate stand` on pictures that the simulator draws from several stands.

#include <cmath>
#include <regex>

#include "Files.hpp"
#include "Paths.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

const std::string kField = std::string(ORTUNG_SOURCE_DIR) + "/maps/fields/msl.toml";

class StandCalibration : public Workspace {
 protected:
  /// Draws a picture by a camera that looks down by 3 degrees more than its sensors say.
  std::string stand(const std::string& start, double tilt, const std::string& place) {
    const std::string name = "from" + std::to_string(++count_);
    write("robot.toml",
          "[robot]\nname = \"tall\"\n[[sensor]]\nplugin = \"camera\"\nmodel = \"front\"\n"
          "pose = { z_m = 0.75 }\n[sensor.camera]\nsize_px = [480, 360]\n"
          "focal_px = [320.0, 320.0]\ntilt_deg = " +
              std::to_string(tilt + 3.0) + "\n");
    const Outcome drawn =
        ortung({"export", "images", "sim:" + kField + "?speed=0&duration=0.1&start=" + start,
                "--robot", path("robot.toml"), "--out", path(name), "--count", "1"});
    EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
    return "[[stand]]\npicture = \"" + name +
           "/images/000000.png\"\ntilt_deg = " + std::to_string(tilt) + "\nplace_m = " + place +
           "\n";
  }
  Outcome calibrate(const std::vector<std::string>& more = {}) {
    std::vector<std::string> all = {
        "calibrate", "stand", path("stands.toml"), "--world", kField,
        "--height",  "0.72",  "--focal-px",        "310",     "--plain"};
    all.insert(all.end(), more.begin(), more.end());
    return ortung(all);
  }

 private:
  int count_ = 0;
};

double numberIn(const std::string& text, const std::string& pattern) {
  std::smatch found;
  EXPECT_TRUE(std::regex_search(text, found, std::regex(pattern))) << pattern << "\n" << text;
  return found.empty() ? NAN : std::stod(found[1]);
}

// The places are given as if the field were a tenth larger than the world says.
TEST_F(StandCalibration, TellsHeightOffsetAndTheFieldsScale) {
  write("stands.toml", stand("-3,2,60", 17.0, "[-3.3, 2.2]") + stand("0,-3,100", 14.0, "[0, 3.3]") +
                           stand("2,1,-160", 20.0, "[2.2, 1.1]"));
  const Outcome outcome = calibrate({"--out", path("camera.toml"), "--draw", path("drawn")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err << outcome.out;
  EXPECT_NEAR(numberIn(outcome.out, "the field is (\\S+) times"), 1.1, 0.02) << outcome.out;
  EXPECT_NEAR(numberIn(outcome.out, "height (\\S+) m"), 1.1 * 0.75, 0.03);
  EXPECT_NEAR(numberIn(outcome.out, "tilt (\\S+) degrees where"), 3.0, 0.5);
  EXPECT_NEAR(numberIn(read("camera.toml"), "focal_px = .(\\S+),"), 320.0, 10.0);
  for (const char* name : {"drawn/01-000000.png", "drawn/02-000000.png", "drawn/03-000000.png"})
    EXPECT_TRUE(read(name).starts_with("\x89PNG")) << name;
}

TEST_F(StandCalibration, OfOneStandIsNotDetermined) {
  write("stands.toml", stand("-3,2,60", 17.0, "[-3, 2]"));
  const Outcome outcome = calibrate({"--out", path("camera.toml")});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.err.find("not determined: take pictures from more stands"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(path("camera.toml")));
}

TEST_F(StandCalibration, RefusesFilesThatSayNothing) {
  write("stands.toml", "[[stand]]\npicture = \"a.png\"\ntilt = 3\n");
  expectRefused(calibrate(), 1, "ortung calibrate stand: " + path("stands.toml"), {"tilt_deg"});
  write("stands.toml", "[[stand]]\npicture = \"a.png\"\ntilt_deg = 3\nplace_m = [1]\n");
  expectRefused(calibrate(), 1, "ortung calibrate stand: " + path("stands.toml"), {"place_m"});
  write("stands.toml", "");
  expectRefused(calibrate(), 1, "ortung calibrate stand: " + path("stands.toml"), {"[[stand]]"});
}

}  // namespace
}  // namespace ortung::test

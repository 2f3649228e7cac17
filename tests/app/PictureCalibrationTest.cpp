// `ortung calibrate` on pictures of a field that the simulator draws.

#include <cmath>
#include <numbers>
#include <regex>

#include "DecodedPng.hpp"
#include "Files.hpp"
#include "Paths.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
const std::string kField = std::string(ORTUNG_SOURCE_DIR) + "/maps/fields/msl.toml";

const char* const kTall = R"([robot]
name = "tall"
[[sensor]]
plugin = "camera"
model = "front"
pose = { z_m = 0.75 }
[sensor.camera]
size_px = [480, 360]
focal_px = [320.0, 320.0]
tilt_deg = 20
)";

class PictureCalibration : public Workspace {
 protected:
  PictureCalibration() {
    write("eyes.toml", R"([robot]
name = "eyes"
[[sensor]]
plugin = "camera"
model = "front"
pose = { x_m = 0.1, z_m = 0.6 }
[sensor.camera]
size_px = [160, 120]
focal_px = [105.0, 105.0]
tilt_deg = 15
[[sensor]]
plugin = "camera"
model = "small"
pose = { z_m = 0.75 }
[sensor.camera]
size_px = [80, 60]
focal_px = [50.0, 50.0]
tilt_deg = 30
)");
    const Outcome outcome =
        ortung({"export", "images", "sim:" + kField + "?speed=0&duration=0.1&start=2,1,-15",
                "--robot", path("eyes.toml"), "--out", path("set"), "--count", "2"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  }
  std::string picture(int number) const {
    return path("set/images/00000" + std::to_string(number) + ".png");
  }
};

TEST_F(PictureCalibration, ColoursArePrintedOrWrittenAndPicturesDrawn) {
  const fs::path before = fs::current_path();
  const fs::path here = path("here");
  fs::create_directory(here);
  fs::current_path(here);
  const Outcome printed = ortung({"calibrate", "colours", picture(0), picture(1)});
  fs::current_path(before);
  ASSERT_EQ(printed.exitCode, 0) << printed.err;
  EXPECT_TRUE(printed.out.starts_with("[sensor.colours]\n")) << printed.out;
  const Outcome written = ortung({"calibrate", "colours", picture(0), picture(1), "--out",
                                  path("colours.toml"), "--draw", path("drawn/deep")});
  ASSERT_EQ(written.exitCode, 0) << written.err;
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(read("colours.toml"), printed.out);
  EXPECT_TRUE(fs::is_empty(here)) << "nothing is drawn that nobody wants";
  for (const char* name : {"drawn/deep/000000.png", "drawn/deep/000001.png"})
    EXPECT_TRUE(read(name).starts_with("\x89PNG")) << name;
  expectRefused(ortung({"calibrate", "colours", picture(0), "--out", path("colours.toml")}), 1,
                "ortung calibrate colours: " + path("colours.toml"), {"--force"});
}

/// Which share of the blue dots that were drawn near the robot is on something white in the
/// picture, to 4 pixels. Farther away lines are too thin to be there.
double shareOnLines(const std::string& picture, const std::string& drawn) {
  const auto decoded = [](const std::string& text) {
    return app::DecodedPng(std::as_bytes(std::span(text)));
  };
  const app::DecodedPng before = decoded(picture);
  const app::DecodedPng after = decoded(drawn);
  const auto isOnLine = [&](int x, int y) {
    for (int v = std::max(y - 4, 0); v <= std::min(y + 4, before.height - 1); ++v)
      for (int u = std::max(x - 4, 0); u <= std::min(x + 4, before.width - 1); ++u) {
        const app::Colour c = before.at(u, v);
        if (std::min({c.red, c.green, c.blue}) > 140) return true;
      }
    return false;
  };
  constexpr int kNear = 110;  // row of what is 5 m away
  int dots = 0;
  int good = 0;
  for (int y = kNear; y < after.height; ++y)
    for (int x = 0; x < after.width; ++x) {
      if (!after.is(x, y, {0, 0, 255})) continue;
      ++dots;
      good += isOnLine(x, y) ? 1 : 0;
    }
  EXPECT_GT(dots, 100);
  return static_cast<double>(good) / std::max(dots, 1);
}

// The camera that has drawn the pictures is known, and where it stood. A field looks the same from
// the other side.
TEST_F(PictureCalibration, LinesTellTheCameraThatDrewThemAndWhereItStood) {
  constexpr double kFocal = 320.0, kHeight = 0.75, kTilt = 20.0;
  write("tall.toml", kTall);
  struct Place {
    const char* start;
    double x, y, heading;  ///< [m], [degrees]
  };
  const Place places[] = {{"-3,2,60", -3.0, 2.0, 60.0}, {"0,-3,100", 0.0, -3.0, 100.0}};
  for (const Place& place : places) {
    const std::string set = std::string("set") + place.start;
    const Outcome drawn =
        ortung({"export", "images", "sim:" + kField + "?speed=0&duration=0.1&start=" + place.start,
                "--robot", path("tall.toml"), "--out", path(set), "--count", "1"});
    ASSERT_EQ(drawn.exitCode, 0) << drawn.err;
    fs::rename(path(set + "/images/000000.png"), path(std::string(place.start) + ".png"));
  }
  const std::string one = path("-3,2,60.png"), other = path("0,-3,100.png");
  const Outcome outcome =
      ortung({"calibrate", "lines", one, other, "--world", kField, "--height", "0.72",
              "--height-share", "0.05", "--out", path("camera.toml"), "--draw", path("drawn")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const auto numberIn = [](const std::string& text, const std::string& pattern) {
    std::smatch found;
    EXPECT_TRUE(std::regex_search(text, found, std::regex(pattern))) << pattern << "\n" << text;
    return found.empty() ? NAN : std::stod(found[1]);
  };
  for (const Place& place : places) {
    const std::string begin = std::string(place.start) + "\\.png .* ";
    const double x = numberIn(outcome.out, begin + "(\\S+) m, \\S+ m, ");
    const double y = numberIn(outcome.out, begin + "(\\S+) m, \\S+ degrees");
    const double heading = numberIn(outcome.out, begin + "(\\S+) degrees");
    const bool isMirrored = std::cos((heading - place.heading) * kDegree) < 0.0;
    const double side = isMirrored ? -1.0 : 1.0;
    EXPECT_NEAR(side * x, place.x, 0.2) << place.start;
    EXPECT_NEAR(side * y, place.y, 0.2) << place.start;
    EXPECT_GT(side * std::cos((heading - place.heading) * kDegree), std::cos(3.0 * kDegree));
  }
  const std::string camera = read("camera.toml");
  EXPECT_NEAR(numberIn(camera, "z_m = (\\S+) "), kHeight, 0.03);
  EXPECT_NEAR(numberIn(camera, "tilt_deg = (\\S+)"), kTilt, 2.0);
  EXPECT_NEAR(numberIn(camera, "focal_px = .(\\S+),"), kFocal, 0.05 * kFocal);
  for (const std::string name : {"-3,2,60.png", "0,-3,100.png"}) {
    EXPECT_TRUE(read("drawn/" + name).starts_with("\x89PNG")) << name;
    EXPECT_FALSE(read("drawn/" + name) == read(name)) << "nothing is drawn into " << name;
  }
}

TEST_F(PictureCalibration, TheFieldIsDrawnWhereThePictureHasItsLines) {
  const std::string circle = "center_m = [0, 0]\nsize_m = [4, 4]\n";
  std::string field = readBytes(kField);
  ASSERT_NE(field.find(circle), field.npos);
  write("arcs.toml", field.replace(field.find(circle), circle.size(),
                                   "center_m = [1, 0.5]\nsize_m = [5, 2.5]\nangle_deg = 40\n"));
  write("tall.toml", kTall);
  const Outcome seen = ortung(
      {"export", "images", "sim:" + path("arcs.toml") + "?speed=0&duration=0.1&start=3,-2,140",
       "--robot", path("tall.toml"), "--out", path("arcs"), "--count", "1"});
  ASSERT_EQ(seen.exitCode, 0) << seen.err;
  const Outcome outcome =
      ortung({"calibrate", "lines", path("arcs/images/000000.png"), "--world", path("arcs.toml"),
              "--height", "0.75", "--height-share", "0.05", "--draw", path("drawn")});
  // A single picture need not determine its camera.
  ASSERT_LE(outcome.exitCode, 1) << outcome.err;
  EXPECT_GT(shareOnLines(read("arcs/images/000000.png"), read("drawn/000000.png")), 0.95);
}

// A picture of bare floor and one far line: it is said what is missing, and which pictures would
// help; nothing is written but the verdict.
TEST_F(PictureCalibration, ACameraThatPicturesDoNotDetermineIsNotWritten) {
  write("tall.toml", kTall);
  const Outcome seen =
      ortung({"export", "images", "sim:" + kField + "?speed=0&duration=0.1&start=4,1,90", "--robot",
              path("tall.toml"), "--out", path("bare"), "--count", "1"});
  ASSERT_EQ(seen.exitCode, 0) << seen.err;
  const Outcome outcome = ortung({"calibrate", "lines", path("bare/images/000000.png"), "--world",
                                  kField, "--out", path("camera.toml"), "--draw", path("drawn")});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.out.find("verdict: not determined: take pictures that"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("NOT MET"), std::string::npos) << outcome.out;
  EXPECT_TRUE(
      outcome.err.starts_with("ortung calibrate lines: the camera is not determined: take "))
      << outcome.err;
  EXPECT_FALSE(fs::exists(path("camera.toml")));
  EXPECT_TRUE(fs::exists(path("drawn/000000.png"))) << "the picture shows why";
  const std::string verdict = read("camera.verdict.json");
  EXPECT_NE(verdict.find("\"determined\": false"), std::string::npos) << verdict;
  EXPECT_NE(verdict.find("\"met\": false"), std::string::npos) << verdict;
}

TEST_F(PictureCalibration, CamerasOfAKindAreReadAndOthersRefused) {
  write("other.toml",
        "[sensor.camera]\nmodel = \"perspective\"\nsize_px = [160, 120]\n"
        "focal_px = [100, 100]\n");
  expectRefused(
      ortung({"calibrate", "lines", picture(0), "--world", kField, "--like", path("other.toml")}),
      1, "ortung calibrate lines: " + path("other.toml"), {"perspective", "fisheye"});
  write("large.toml",
        "[sensor.camera]\nmodel = \"fisheye\"\nsize_px = [608, 800]\n"
        "focal_px = [330, 330]\n");
  expectRefused(
      ortung({"calibrate", "lines", picture(0), "--world", kField, "--like", path("large.toml")}),
      1, "ortung calibrate lines: " + path("large.toml"), {"608 x 800", "160 x 120"});
}

TEST_F(PictureCalibration, PicturesAreNeverDrawnOver) {
  const std::string before = read("set/images/000000.png");
  expectRefused(
      ortung({"calibrate", "colours", picture(0), "--draw", path("set/images"), "--force"}), 2,
      "ortung calibrate colours: " + picture(0) + ": is read by this run", {"--draw"});
  EXPECT_TRUE(read("set/images/000000.png") == before);
}

TEST_F(PictureCalibration, PicturesOfAnotherSizeAreOfAnotherCamera) {
  const std::string reason =
      picture(1) + ": has another size than " + picture(0) + ", so it is of another camera";
  expectRefused(ortung({"calibrate", "lines", picture(0), picture(1), "--world", kField}), 1,
                "ortung calibrate lines: " + reason, {});
  const Outcome camera = ortung({"calibrate", "camera", picture(0), picture(1)});
  EXPECT_EQ(camera.exitCode, 1);
  EXPECT_NE(camera.err.find("ortung calibrate camera: " + reason), std::string::npos) << camera.err;
}

TEST_F(PictureCalibration, PicturesWithoutABoardAreNamedAndThenThereIsNone) {
  const Outcome outcome =
      ortung({"calibrate", "camera", picture(0), "--board", "5x4", "--out", path("camera.toml")});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_TRUE(outcome.err.starts_with("ortung calibrate camera: warning: " + picture(0) +
                                      ": does not show a whole board of 5 x 4 inner corners; left "
                                      "out\n"))
      << outcome.err;
  EXPECT_FALSE(fs::exists(path("camera.toml")));
}

TEST_F(PictureCalibration, WhatIsNoPictureIsNamed) {
  for (const char* command : {"camera", "colours"})
    expectRefused(ortung({"calibrate", command, path("hall.toml")}), 1,
                  std::string("ortung calibrate ") + command + ": " + path("hall.toml"), {});
}

}  // namespace
}  // namespace ortung::test

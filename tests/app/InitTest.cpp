#include <gtest/gtest.h>

#include <regex>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

using Init = Workspace;

/// Returns a template's text with the keys that it has commented out.
std::string uncommented(const std::string& text) {
  // Of keys without a default the value is only an example.
  const std::string kept =
      std::regex_replace(text, std::regex("\n#[^\n]*without it another[^\n]*"), "");
  return std::regex_replace(kept, std::regex("(^|\n)#([a-z_0-9]+ = |\\[\\[)"), "$1$2");
}

TEST_F(Init, WhatItWritesIsEnoughToLocalize) {
  ASSERT_EQ(ortung({"init", "robot", "--out", path("r.toml")}).exitCode, 0);
  ASSERT_EQ(ortung({"init", "world", "--out", path("w.toml")}).exitCode, 0);
  const Outcome learned = ortung(
      {"learn", "--world", path("w.toml"), "--robot", path("r.toml"), "--out", path("t.ortung")});
  ASSERT_EQ(learned.exitCode, 0) << learned.err;
  const Outcome eval = ortung({"eval", "--source", "sim:" + path("w.toml") + "?duration=40",
                               "--robot", path("r.toml"), "--tables", path("t.ortung")});
  ASSERT_EQ(eval.exitCode, 0) << eval.err;
  EXPECT_EQ(eval.out.find("not converged"), eval.out.npos) << eval.out;
}

TEST_F(Init, TheDefaultsThatItShowsAreThose) {
  ASSERT_EQ(ortung({"init", "robot", "--out", path("r.toml")}).exitCode, 0);
  ASSERT_EQ(ortung({"init", "world", "--out", path("w.toml")}).exitCode, 0);
  write("r2.toml", uncommented(read("r.toml")));
  write("w2.toml", uncommented(read("w.toml")));
  EXPECT_NE(read("r2.toml"), read("r.toml"));
  EXPECT_NE(read("w2.toml"), read("w.toml"));
  const Outcome check = ortung({"check", path("r2.toml"), path("w2.toml")});
  EXPECT_EQ(check.exitCode, 0) << check.err;
}

TEST_F(Init, WhatItSaysOfMotionIsWhatTheModelSays) {
  ASSERT_EQ(ortung({"init", "robot", "--out", path("r.toml")}).exitCode, 0);
  const std::string model = ortung({"plugins", "motion", "odometry"}).out;
  const std::string robot = read("r.toml");
  const std::string table =
      robot.substr(robot.find("[motion]"), robot.find("[drive]") - robot.find("[motion]"));
  const std::regex line("\n#([a-z_]+) = ([0-9.]+) ");
  int count = 0;
  for (std::sregex_iterator at(table.begin(), table.end(), line), end; at != end; ++at, ++count)
    EXPECT_TRUE(std::regex_search(
        model, std::regex("(^|\n)" + at->str(1) + " [^\n]*default: " + at->str(2) + "\n")))
        << at->str() << " but\n"
        << model;
  EXPECT_EQ(count, 4) << table;
}

TEST_F(Init, EverySensorsKeysCanBeUncommented) {
  // Not lrf_cylinders, which wants the name of a scanner that the robot has.
  for (const char* sensor :
       {"camera", "compass", "landmarks", "lrf", "odometry", "sonar", "iconic_omnivision"}) {
    ASSERT_EQ(
        ortung({"init", "robot", "--sensor", sensor, "--out", path("s.toml"), "--force"}).exitCode,
        0);
    const Outcome check = ortung({"check", path("s.toml")});
    EXPECT_EQ(check.exitCode, 0) << sensor << check.err;
    EXPECT_NE(read("s.toml").find("period_s"), std::string::npos) << sensor;
  }
  expectRefused(ortung({"init", "robot", "--sensor", "lfr", "--out", path("x.toml")}), 1,
                "ortung init robot: there is no plugin 'lfr'", {"did you mean 'lrf'?"});
}

TEST_F(Init, SeveralSensorsOfAKindHaveNamesOfTheirOwn) {
  ASSERT_EQ(ortung({"init", "robot", "--sensor", "sonar", "--sensor", "sonar", "--sensor", "lrf",
                    "--sensor", "sonar", "--out", path("s.toml")})
                .exitCode,
            0);
  const Outcome check = ortung({"check", path("s.toml")});
  EXPECT_EQ(check.exitCode, 0) << check.err;
  for (const char* name : {"sonar/ultrasonic/sonar0", "sonar2/ultrasonic/sonar0",
                           "sonar3/ultrasonic/sonar0", "LMS200/LRF"})
    EXPECT_NE(check.out.find(name), std::string::npos) << check.out;
}

TEST_F(Init, OverwritesNothingUnasked) {
  write("r.toml", "mine");
  expectRefused(ortung({"init", "robot", "--out", path("r.toml")}), 1,
                "ortung init robot: ", {"is there already", "--force"});
  EXPECT_EQ(read("r.toml"), "mine");
  EXPECT_EQ(ortung({"init", "robot", "--out", path("r.toml"), "--force"}).exitCode, 0);
  EXPECT_NE(read("r.toml"), "mine");
}

TEST_F(Init, AMapIsNamedAsSeenFromTheWorld) {
  write("map.yaml",
        "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  write(
      "map.pgm", "P2\n8 8\n255\n" + [] {
        std::string cells;
        for (int i = 0; i < 64; ++i) cells += i < 8 ? "0 " : "254 ";
        return cells;
      }());
  ASSERT_EQ(ortung({"init", "world", "--map", path("map.yaml"), "--out", path("w.toml")}).exitCode,
            0);
  EXPECT_EQ(ortung({"check", path("w.toml")}).exitCode, 0);
  // The map alone is the same world.
  const auto fingerprint = [&](const std::string& file) {
    const Outcome outcome = ortung({"check", path(file)});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::size_t at = outcome.out.find("fingerprint ");
    return outcome.out.substr(at, 28);
  };
  EXPECT_EQ(fingerprint("w.toml"), fingerprint("map.yaml"));
  const Outcome learned = ortung({"learn", "--world", path("map.yaml"), "--robot",
                                  path("robot.toml"), "--out", path("m.ortung")});
  EXPECT_EQ(learned.exitCode, 0) << learned.err;
}

TEST_F(Init, ASensorHasItsName) {
  const Outcome outcome = ortung({"init", "sensor", "whisker", "--out", path("whisker")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(read("whisker/whisker.cpp").find("provideData<makeData>(\"whisker\")"),
            std::string::npos);
  EXPECT_NE(read("whisker/CMakeLists.txt").find("ortung_whisker_device"), std::string::npos);
  for (const char* file : {"whisker.cpp", "CMakeLists.txt", "whisker.toml"})
    EXPECT_EQ(read(std::string("whisker/") + file).find("@NAME@"), std::string::npos) << file;
  expectRefused(ortung({"init", "sensor", "../x"}), 2, "ortung init sensor: ", {"a-z, 0-9, _"});
}

TEST_F(Init, ASensorHidesNoOtherUnasked) {
  expectRefused(ortung({"init", "sensor", "lrf", "--out", path("lrf")}), 2,
                "ortung init sensor: there is a sensor 'lrf' already", {"my_lrf", "--force"});
  EXPECT_FALSE(std::filesystem::exists(path("lrf")));
  EXPECT_EQ(ortung({"init", "sensor", "lrf", "--out", path("lrf"), "--force"}).exitCode, 0);
  EXPECT_NE(read("lrf/lrf.cpp"), "");
}

}  // namespace
}  // namespace ortung::test

// What `ortung show` prints beside its picture.
#include <cmath>
#include <sstream>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

class ShownTexts : public Workspace {
 protected:
  ShownTexts() { learnTables(); }
  std::vector<std::string> command(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"show",  path("hall.ortung"), "--robot", path("robot.toml"),
                                      "--out", path("heat.png")};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string shown(const std::vector<std::string>& more) const {
    const Outcome outcome = ortung(command(more));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return outcome.out;
  }
  /// The values of the legend, whose lines are even steps of colour.
  static std::vector<double> legendOf(const std::string& text) {
    std::vector<double> values;
    for (int percent = 0; percent <= 100; percent += 25) {
      std::ostringstream begin;
      begin << "\n  colour "
            << std::string(percent < 10    ? 2
                           : percent < 100 ? 1
                                           : 0,
                           ' ')
            << percent << " %: ";
      const std::size_t at = text.find(begin.str());
      EXPECT_NE(at, std::string::npos) << begin.str() << text;
      if (at != std::string::npos)
        values.push_back(std::stod(text.substr(at + begin.str().size())));
    }
    return values;
  }
};

// The 30th of 60 beams looks 1.5 degrees to the left; the hall is 4 m long in y.
TEST_F(ShownTexts, ExpectationsAreOfOneBeamAndOneHeading) {
  const std::string text =
      shown({"--feature", "LMS200/LRF/*", "--beam", "30", "--heading", "-270"});
  EXPECT_TRUE(text.starts_with("expectation of LMS200/LRF/180DegreeScan [30], heading 90 deg\n"))
      << text;
  const std::vector<double> legend = legendOf(text);
  ASSERT_EQ(legend.size(), 5u);
  EXPECT_GT(legend[0], 0.0);
  EXPECT_LT(legend[0], 0.1) << "before the wall";
  EXPECT_GT(legend[4], 3.9) << "from one wall to the other";
  EXPECT_LT(legend[4], 4.1);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_NEAR(legend[i], legend[0] + 0.25 * static_cast<double>(i) * (legend[4] - legend[0]),
                2e-3);
}

TEST_F(ShownTexts, ProbabilitiesOfASourceAreThoseOfItsRecord) {
  recordRun();
  const std::vector<std::string> reading = {"--feature", "*/LRF/*", "--at", "5"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = reading;
    all.insert(all.end(), more.begin(), more.end());
    return shown(all);
  };
  const std::string text = with({"--record", path("run.rec"), "--log"});
  EXPECT_TRUE(text.starts_with("p(*/LRF/*) at 5 s; each cell: the best of 90 headings\n")) << text;
  EXPECT_EQ(with({"--source", "record:" + path("run.rec"), "--scale", "log"}), text);
  const std::vector<double> legend = legendOf(text);
  ASSERT_EQ(legend.size(), 5u);
  for (std::size_t i = 1; i < 4; ++i)  // even in logarithms; four digits are printed
    EXPECT_NEAR(legend[i] / legend[i - 1], legend[4] / legend[3], 2e-3 * legend[4] / legend[3]);
  const std::vector<double> linear =
      legendOf(with({"--record", path("run.rec"), "--scale", "linear"}));
  EXPECT_NEAR(linear[2], (linear[0] + linear[4]) / 2, 1e-3 * linear[4]);
  // One of both poses is printed beside the other: the scan says where the robot is.
  double x[2], y[2], p[2];
  const char* names[] = {"\n  most probable pose: ", "\n  true pose: "};
  for (int i = 0; i < 2; ++i) {
    const std::size_t at = text.find(names[i]);
    ASSERT_NE(at, std::string::npos) << text;
    double degrees = 0.0;
    ASSERT_EQ(std::sscanf(text.c_str() + at + std::string(names[i]).size(),
                          "%lf m, %lf m, %lf deg, p = %lf", &x[i], &y[i], &degrees, &p[i]),
              4);
  }
  EXPECT_LT(std::hypot(x[0] - x[1], y[0] - y[1]), 0.2);
  EXPECT_NEAR(p[0], legend[4], 1e-3 * p[0]) << "the greatest of the picture";
}

TEST_F(ShownTexts, WhatHasNoReadingYetIsRefused) {
  write("run.rec", "# ortung record 1\n0 odometry/odometry/pose 5 0 0 18000 0 0\n");
  expectRefused(ortung(command({"--feature", "*/LRF/*", "--record", path("run.rec")})), 1,
                "ortung show: record:" + path("run.rec"),
                {"no feature that matches '*/LRF/*' has a reading", "try a later --at"});
}

}  // namespace
}  // namespace ortung::test

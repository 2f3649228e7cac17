/// What logs say of their scanners, what options change of it, and the robot file of that.

#include <numbers>

#include "LogTesting.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/realsensors/Scanner.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
constexpr double kPi = std::numbers::pi;

/// Applies options such as "laser_x" to a scanner.
Scanner applied(const std::map<std::string, std::string>& options, const Scanner& scanner) {
  Parameters parameters("scanlog");
  for (const auto& [key, value] : options) parameters.set(key, value);
  return ScannerOptions(parameters).apply(scanner, "a.log:3");
}

Scanner scannerOf(int beams, double first, double step) {
  Scanner scanner;
  scanner.beams = beams;
  scanner.firstAngle = first;
  scanner.angleStep = step;
  return scanner;
}

TEST(ScannersOfLogs, KeepWhatNoOptionChanges) {
  Scanner scanner = scannerOf(3, -1.0, 1.0);
  scanner.mount = {0.25, -0.5, 1.5};
  scanner.maxRange = 8.0;
  const Scanner same = applied({}, scanner);
  EXPECT_EQ(same.mount.x, 0.25);
  EXPECT_EQ(same.mount.y, -0.5);
  EXPECT_EQ(same.mount.theta, 1.5);
  EXPECT_EQ(same.maxRange, 8.0);
  const Scanner moved = applied({{"laser_y", "2"}}, scanner);
  EXPECT_EQ(moved.mount.x, 0.25);
  EXPECT_EQ(moved.mount.y, 2.0);
  EXPECT_EQ(moved.mount.theta, 1.5);
  EXPECT_NEAR(applied({{"laser_yaw_deg", "-270"}}, scanner).mount.theta, kPi / 2, 1e-12);
}

// Old scanners see little beyond 30 m, whatever they say; an option may say otherwise.
TEST(ScannersOfLogs, SeeUpTo30MetresUnlessAnOptionSaysMore) {
  Scanner scanner = scannerOf(3, -1.0, 1.0);
  EXPECT_EQ(applied({}, scanner).maxRange, 30.0);
  scanner.maxRange = 81.0;
  EXPECT_EQ(applied({}, scanner).maxRange, 30.0);
  EXPECT_EQ(applied({{"max_range_m", "81"}}, scanner).maxRange, 81.0);
  scanner.maxRange = 0.01;
  EXPECT_EQ(applied({}, scanner).maxRange, 0.1);
}

TEST(ScannersOfLogs, HaveBeamsWithinATurnAndAPositiveStep) {
  const auto complaint = [](int beams, double first, double step) {
    return errorOf([&] { applied({}, scannerOf(beams, first, step)); });
  };
  EXPECT_EQ(complaint(1, 0.0, 0.1), "");
  EXPECT_EQ(complaint(8192, 0.0, 1e-4), "");
  EXPECT_EQ(complaint(0, 0.0, 0.1), "a.log:3: found 0 beams, expected 1 to 8192");
  EXPECT_EQ(complaint(8193, 0.0, 1e-4), "a.log:3: found 8193 beams, expected 1 to 8192");
  EXPECT_EQ(complaint(2, 6.25, 0.1), "");
  EXPECT_EQ(complaint(2, -6.25, 0.1), "");
  for (const auto& [beams, first, step] : {std::tuple{2, 0.0, 0.0},
                                           {2, 0.0, -0.1},
                                           {2, 6.5, 0.1},
                                           {2, -6.5, 0.1},
                                           {4, 0.0, 1.572},
                                           {2, 0.0, std::nan("")},
                                           {2, std::nan(""), 0.1}})
    EXPECT_NE(complaint(beams, first, step).find("expected a positive step, and a turn at most"),
              std::string::npos)
        << beams << " " << first << " " << step;
}

// 4 beams of 1.5709 rad are 0.0004 rad more than a turn: the log has rounded.
TEST(ScannersOfLogs, RoundedStepsDoNotReachBeyondATurn) {
  EXPECT_DOUBLE_EQ(applied({}, scannerOf(4, 0.0, 1.5709)).angleStep, kPi / 2);
  EXPECT_DOUBLE_EQ(applied({}, scannerOf(4, 0.0, 1.57)).angleStep, 1.57);
}

TEST(ScannersOfLogs, RefuseOptionsOutOfRange) {
  for (const auto& [key, value] : {std::pair{"laser_x", "10.5"},
                                   {"laser_x", "-10.5"},
                                   {"laser_y", "11"},
                                   {"laser_y", "-11"},
                                   {"laser_yaw_deg", "361"},
                                   {"max_range_m", "0.05"},
                                   {"max_range_m", "1001"},
                                   {"max_range_m", "far"}})
    EXPECT_NE(errorOf([&] { applied({{key, value}}, scannerOf(3, 0, 1)); }).find(key),
              std::string::npos)
        << key << " " << value;
}

TEST(MedianPeriod, IsTheMiddleOneOfTheStepsBetweenScans) {
  EXPECT_EQ(medianPeriod({}), 1.0);
  EXPECT_EQ(medianPeriod({7}), 1.0);
  EXPECT_EQ(medianPeriod({0, 250'000}), 0.25);
  EXPECT_EQ(medianPeriod({0, 100'000, 5'000'000, 5'200'000}), 0.2) << "a pause does not matter";
  EXPECT_EQ(medianPeriod({0, 100'000, 400'000}), 0.3) << "of two the greater one";
}

TEST(RobotHead, IsNamedAfterTheLog) {
  const auto nameIn = [](const std::string& path) {
    const std::string head = robotHead(path);
    const std::size_t at = head.find("name = ") + 7;
    return head.substr(at, head.find('\n', at) - at);
  };
  EXPECT_EQ(nameIn("/logs/intel"), "\"intel\"");
  EXPECT_EQ(nameIn("/logs/intel/"), "\"intel\"");
  EXPECT_EQ(nameIn("/logs/aces.log.gz"), "\"aces.log\"");
  EXPECT_EQ(nameIn("/logs/./x/../hall.log"), "\"hall\"");
  EXPECT_EQ(nameIn("/"), "\"robot\"");
  EXPECT_EQ(nameIn("a\"b"), "\"a\\\"b\"");
}

TEST(ScannerToml, GivesAnglesInDegreesRoundedToMillionths) {
  Scanner scanner = scannerOf(361, -kPi / 2, kPi / 360);
  scanner.mount = {0.5, -0.25, kPi / 6};
  scanner.maxRange = 12.5;
  const std::string text = scannerToml(scanner, 0.025, {"LMS", "LRF", "front"});
  EXPECT_TRUE(text.starts_with(
      "\n[[sensor]]\nplugin = \"lrf\"\nmodel = \"LMS\"\ntype = \"LRF\"\nfeature = \"front\"\n"
      "pose = { x_m = 0.5, y_m = -0.25, theta_deg = 30.0 }\nbeams = 361\n"
      "first_angle_deg = -90.0\nangle_step_deg = 0.5\nmax_range_m = 12.5\nperiod_s = 0.025\n"))
      << text;
}

// 7 beams of 360 / 7 degrees: rounded up, they would be more than a turn.
TEST(ScannerToml, DoesNotRoundATurnUp) {
  Scanner scanner = scannerOf(7, 0.0, 2 * kPi / 7);
  scanner.maxRange = 8.0;
  const std::string text = scannerToml(scanner, 1.0);
  const std::string key = "angle_step_deg = ";
  const double step = std::stod(text.substr(text.find(key) + key.size()));
  EXPECT_LE(7 * step, 360.0);
  EXPECT_NEAR(step, 360.0 / 7, 1e-6);
}

}  // namespace
}  // namespace ortung

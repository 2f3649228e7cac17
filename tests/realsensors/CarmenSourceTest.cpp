#include <cmath>

#include "LogTesting.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

/// FLASER with 2 beams.
std::string scan(const std::string& ranges, const std::string& pose, const std::string& odometry,
                 const std::string& time) {
  return "FLASER 2 " + ranges + " " + pose + " " + odometry + " " + time + " host " + time + "\n";
}

std::string odometry(const std::string& pose, const std::string& time) {
  return "ODOM " + pose + " 0 0 0 " + time + " host " + time + "\n";
}

class CarmenSource : public ::testing::Test {
 protected:
  std::string text(const std::string& bytes, const std::string& options = "") const {
    return "carmen:" + folder_.write("a.log", bytes).string() + options;
  }
  std::string path() const { return (folder_.path() / "a.log").string(); }
  TemporaryFolder folder_;
};

TEST_F(CarmenSource, TakesTheOdometryOfARawLogAsItStands) {
  const std::string log = "# CARMEN\nPARAM robot_frontlaser_offset 0.1 nohost 0\n" +
                          odometry("1 0 0", "0.9") + scan("1.5 81.91", "1.1 0 0", "1 0 0", "1.0") +
                          scan("0 2", "1.6 0 0", "1.5 0 0", "2.0");
  const auto source = makeSource(text(log));
  EXPECT_EQ(
      asText(readAll(*source)),
      (Texts{"1000000 odometry/odometry/pose 2147484648 2147483648 18000 2147483648 2147483648",
             "1000000 laser/LRF/scan 1500 81910",
             "2000000 odometry/odometry/pose 2147485148 2147483648 18000 2147484148 2147483648",
             "2000000 laser/LRF/scan 0 2000"}));
  EXPECT_NE(source->robotToml().find("x_m = 0.1, y_m = 0.0, theta_deg = 0.0 }\nbeams = 2\n"
                                     "first_angle_deg = -90.0\nangle_step_deg = 90.0\n"),
            std::string::npos)
      << source->robotToml();
}

TEST_F(CarmenSource, RebuildsOdometryBetweenTheCorrectionsOfACorrectedLog) {
  // The wheels say 1 m, then 0.5 m straight on; the correction turns the robot by 90 degrees, so
  // that the next ways lead along y in the log. Not all resets have a time of 0.
  const std::string log =
      odometry("0 0 0", "0.5") + odometry("1 0 0", "1.0") +
      scan("1 1", "0.9 0 1.5707963", "0.9 0 1.5707963", "1.0") + odometry("0.9 0 1.5707963", "0") +
      "NEFF 15\n" + odometry("0.9 0.5 1.5707963", "2.0") +
      scan("2 2", "0.8 0.4 1.5707963", "0.8 0.4 1.5707963", "2.0") +
      odometry("0.8 0.4 1.5707963", "5.33") + odometry("0.8 0.7 1.5707963", "3.0") +
      scan("3 3", "0.8 0.7 1.5707963", "0.8 0.7 1.5707963", "3.0");
  EXPECT_EQ(
      asText(readAll(text(log))),
      (Texts{"1000000 odometry/odometry/pose 2147484648 2147483648 18000 2147483648 2147483648",
             "1000000 laser/LRF/scan 1000 1000",
             "1000000 reference/groundTruth/pose 2147484548 2147483648 27000",
             "2000000 odometry/odometry/pose 2147485148 2147483648 18000 2147484148 2147483648",
             "2000000 laser/LRF/scan 2000 2000",
             "2000000 reference/groundTruth/pose 2147484448 2147484048 27000",
             "3000000 odometry/odometry/pose 2147485448 2147483648 18000 2147483948 2147483648",
             "3000000 laser/LRF/scan 3000 3000",
             "3000000 reference/groundTruth/pose 2147484448 2147484348 27000"}));
}

TEST_F(CarmenSource, TakesPosesFarFromOdometryForCorrectedOnes) {
  const std::string log = scan("1 1", "0 0 0", "0 0 0", "1") + scan("1 1", "1 1 0", "1 0 0", "2");
  EXPECT_EQ(only(readAll(text(log)), "reference/groundTruth/pose").size(), 2u);
}

TEST_F(CarmenSource, ReadsTheNewerLaserMessages) {
  const std::string scanner = "0 -1.5 3.0 1.0 20 0.01 0 3 1 2 3 1 99 ";
  const std::string raw = odometry("1 0 0", "0.5") + "RAWLASER1 " + scanner + "1.0 host 1.0\n";
  EXPECT_EQ(
      asText(readAll(text(raw, "?laser=RAWLASER1"))),
      (Texts{"1000000 odometry/odometry/pose 2147484648 2147483648 18000 2147483648 2147483648",
             "1000000 laser/LRF/scan 1000 2000 3000"}));
  const auto robot = makeSource(text(
      "ROBOTLASER1 " + scanner + "2.2 0 0.5 2 0 0 0 0 1 1 1 1.0 host 1.0\n", "?laser=ROBOTLASER1"));
  // Its odometry is the robot's pose, not that of the laser before it.
  EXPECT_EQ(
      asText(readAll(*robot)),
      (Texts{"1000000 odometry/odometry/pose 2147485648 2147483648 18000 2147483648 2147483648",
             "1000000 laser/LRF/scan 1000 2000 3000"}));
  EXPECT_NE(robot->robotToml().find("x_m = 0.2"), std::string::npos) << robot->robotToml();
  EXPECT_NE(robot->robotToml().find("max_range_m = 20.0"), std::string::npos);
  EXPECT_EQ(errorOf(text(raw)),
            path() +
                ": found no FLASER message but RAWLASER1, expected one; the option"
                " laser names another");
}

TEST_F(CarmenSource, PassesOverOtherMessagesWhateverTheirNames) {
  const std::string good = scan("1 1", "0 0 0", "0 0 0", "1");
  for (const std::string name : {"A", "Z", "AAZZ", "SCANMARK_1", "NMEA-GGA", "X0", "X9"}) {
    EXPECT_EQ(readAll(text(name + " 1 2\n" + good)).size(), 2u) << name;
  }
  for (const std::string name : {"@", "[", "a", "X/", "X:", "Xa", "9X", "_X"}) {
    EXPECT_EQ(errorOf(text(name + " 1 2\n" + good)),
              path() + ":1: found '" + name + "', expected the name of a CARMEN message");
  }
}

TEST_F(CarmenSource, NamesFileAndLineOfWhatIsWrong) {
  const std::string good = scan("1 1", "0 0 0", "0 0 0", "1");
  EXPECT_EQ(errorOf(text(good + "hello\n")),
            path() + ":2: found 'hello', expected the name of a CARMEN message");
  EXPECT_EQ(errorOf(text(good + "FLASER 2 1 1 0 0 0 0 0 0 2 host\n")),
            path() +
                ":2: found 12 fields, expected 13: FLASER, n, n ranges, pose, odometry, time, "
                "host, time");
  EXPECT_EQ(
      errorOf(text("FLASER 99999999999 1\n")),
      path() +
          ":1: found '99999999999' in field 2, expected a number of beams, a number in [1, 8192]");
  EXPECT_EQ(errorOf(text(good + "ODOM 1 2 3\n")),
            path() +
                ":2: found 4 fields, expected 10: ODOM, pose, velocities, acceleration, time, "
                "host, time");
  EXPECT_EQ(
      errorOf(text(good + scan("1 nan", "0 0 0", "0 0 0", "2"))),
      path() + ":2: found 'nan' in field 4, expected a range [m], a number in [-1000000, 1000000]");
  EXPECT_EQ(errorOf(text(scan("1 1", "0 0 0", "0 0 0", "9") + good)),
            path() +
                ":2: found time 1 s after 9 s, expected time to run forwards, or back by at most"
                " jitter_s=1 s");
  EXPECT_EQ(errorOf(text(good + good.substr(0, 18))),
            path() +
                ":2: found 7 fields, expected x [m], a number in [-1000000, 1000000] (the file ends"
                " within this line)");
  EXPECT_EQ(errorOf(text("")),
            path() + ": found no FLASER message, expected one; the option laser names another");
}

TEST_F(CarmenSource, HasNoWorldOfItsOwn) {
  const auto source = makeSource(text(scan("1 1", "0 0 0", "0 0 0", "1")));
  EXPECT_EQ(errorOf([&] { source->writeWorld(folder_.path() / "w.toml"); }),
            path() + ": found no map, expected one; the option map=FILE names it");
}

/// How far words of lengths, in millimetres, and of angles may differ by rounding in the text
/// files.
void expectSame(const Message& a, const Message& b, const std::string& where) {
  ASSERT_EQ(a.stamp, b.stamp) << where;
  ASSERT_EQ(toText(a.id), toText(b.id)) << where;
  ASSERT_EQ(a.words.size(), b.words.size()) << where;
  if (a.id.type == "LRF") {
    EXPECT_EQ(a.words, b.words) << where;
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {  // x, y, angle; velocities differ by what these differ
    const auto difference =
        static_cast<std::int64_t>(a.words[i]) - static_cast<std::int64_t>(b.words[i]);
    EXPECT_LE(std::abs(difference), 1) << where << " word " << i;
  }
}

TEST(CarmenData, IsTheSameAsItsNeutralText) {
  for (const std::string name : {"intel", "aces", "belgioioso", "freiburg-101"}) {
    ORTUNG_NEED_DATA(data, "carmen/" + name);
    const auto log = readAll("carmen:" + (data / (name + "-corrected.log.gz")).string());
    const auto text = readAll("scanlog:" + data.string());
    ASSERT_EQ(log.size(), text.size()) << name;
    for (std::size_t i = 0; i < log.size() && !::testing::Test::HasFailure(); ++i) {
      expectSame(log[i], text[i], name + " message " + std::to_string(i));
    }
  }
}

}  // namespace
}  // namespace ortung

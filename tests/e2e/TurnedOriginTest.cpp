// Real logs whose maps' origins are turned: the robot is where it was, told in the turned map.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <sstream>

#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

const fs::path kData = ORTUNG_SHARED_DATA;
constexpr double kYaw = 37.0 * std::numbers::pi / 180.0;

struct Pose {
  double x, y, theta;
};

/// The origin of a map_server map: x and y of its lower left corner [m].
Pose originOf(const fs::path& yaml) {
  std::ifstream in(yaml);
  Pose origin{};
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("origin: ["))
      std::sscanf(line.c_str(), "origin: [%lf, %lf, %lf]", &origin.x, &origin.y, &origin.theta);
  return origin;
}

Pose turnedAbout(const Pose& origin, const Pose& pose) {
  const double x = pose.x - origin.x;
  const double y = pose.y - origin.y;
  return {origin.x + std::cos(kYaw) * x - std::sin(kYaw) * y,
          origin.y + std::sin(kYaw) * x + std::cos(kYaw) * y,
          std::remainder(pose.theta + kYaw, 2.0 * std::numbers::pi)};
}

/// Turns the map's origin, and with it the reference.
void turnLog(const fs::path& log) {
  const Pose origin = originOf(log / "map.yaml");
  std::ifstream yaml(log / "map.yaml");
  std::ostringstream text;
  for (std::string line; std::getline(yaml, line);) {
    if (line.starts_with("origin: ["))
      text << "origin: [" << origin.x << ", " << origin.y << ", " << std::to_string(kYaw) << "]\n";
    else
      text << line << "\n";
  }
  yaml.close();
  std::ofstream(log / "map.yaml") << text.str();
  std::ifstream reference(log / "ref.txt");
  text.str("");
  text.precision(6);
  text << std::fixed;
  for (std::string line; std::getline(reference, line);) {
    std::istringstream words(line);
    std::string stamp;
    Pose pose{};
    std::string more;
    if (words >> stamp >> pose.x >> pose.y >> pose.theta) {
      std::getline(words, more);
      const Pose there = turnedAbout(origin, pose);
      text << stamp << " " << there.x << " " << there.y << " " << there.theta << more << "\n";
    } else {
      text << line << "\n";
    }
  }
  reference.close();
  std::ofstream(log / "ref.txt") << text.str();
}

/// The poses of a file of `ortung localize`, by their stamps.
std::map<long long, Pose> posesOf(const std::string& file) {
  std::ifstream in(file);
  std::map<long long, Pose> poses;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    long long stamp = 0;
    Pose pose{};
    if (words >> stamp >> pose.x >> pose.y >> pose.theta) poses[stamp] = pose;
  }
  return poses;
}

class TurnedOrigin : public testing::TestWithParam<const char*> {
 protected:
  /// Copies the log, imports it, learns and localizes. @returns the evaluation
  nlohmann::json localize(const std::string& name, bool turns) const {
    const fs::path copy = folder_.path(name);
    fs::create_directory(copy);
    for (const auto& entry : fs::directory_iterator(kData / GetParam()))
      if (entry.is_regular_file()) fs::copy(entry.path(), copy / entry.path().filename());
    if (turns) turnLog(copy);
    const auto file = [&](const std::string& ending) { return folder_.path(name + ending); };
    folder_.run({"import", "scanlog", copy.string(), "--out", file(".rec"), "--world",
                 file(".toml"), "--robot-file", file("-robot.toml")});
    folder_.run({"learn", "--world", file(".toml"), "--robot", file("-robot.toml"), "--out",
                 file(".ortung")});
    const std::vector<std::string> what{"--source", "record:" + file(".rec"),
                                        "--robot",  file("-robot.toml"),
                                        "--tables", file(".ortung")};
    std::vector<std::string> arguments{"localize", "--out", file(".txt")};
    arguments.insert(arguments.end(), what.begin(), what.end());
    folder_.run(arguments);
    return folder_.eval(what);
  }

  Folder folder_;
};

TEST_P(TurnedOrigin, GivesTheTurnedPosesWithTheSameError) {
  if (!fs::exists(kData / GetParam()))
    GTEST_SKIP() << kData / GetParam() << " is not here; it belongs to no repository";
  const auto straight = localize("straight", false);
  const auto turned = localize("turned", true);
  for (const char* figure : {"position_median_m", "position_rmse_m"}) {
    const auto before = straight[figure].get<double>();
    const auto after = turned[figure].get<double>();
    RecordProperty(std::string(figure) + "_straight", std::to_string(before));
    RecordProperty(std::string(figure) + "_turned", std::to_string(after));
    // Cells of tables, of 0.1 m, lie elsewhere in the turned map.
    EXPECT_NEAR(after, before, 0.013) << figure;
  }
  EXPECT_EQ(turned["lost_share"].get<double>(), 0.0);
  const Pose origin = originOf(kData / GetParam() / "map.yaml");
  const auto expected = posesOf(folder_.path("straight.txt"));
  std::vector<double> distances;
  std::vector<double> angles;
  for (const auto& [stamp, pose] : posesOf(folder_.path("turned.txt"))) {
    const auto found = expected.find(stamp);
    if (found == expected.end()) continue;
    const Pose there = turnedAbout(origin, found->second);
    distances.push_back(std::hypot(pose.x - there.x, pose.y - there.y));
    angles.push_back(std::abs(std::remainder(pose.theta - there.theta, 2.0 * std::numbers::pi)));
  }
  ASSERT_GT(distances.size(), 25u);
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  EXPECT_LT(median(distances), 0.03);  // [m]
  EXPECT_LT(median(angles), 0.01);     // [rad]
}

INSTANTIATE_TEST_SUITE_P(RealLog, TurnedOrigin,
                         testing::Values("mrpt_localization_demo", "mrpt_uwb_ro"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace ortung::test

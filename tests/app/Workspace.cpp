#include "Workspace.hpp"

#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHall = R"(# A hall of 6 x 4 m; nothing in it is symmetric.
[world]
name = "hall"
x_m = [-3, 3]
y_m = [-2, 2]
[[rectangle]]
kind = "wall"
center_m = [0, 2.05]
size_m = [6.2, 0.1]
[[rectangle]]
kind = "wall"
center_m = [0, -2.05]
size_m = [6.2, 0.1]
[[rectangle]]
kind = "wall"
center_m = [3.05, 0]
size_m = [0.1, 4]
[[rectangle]]
kind = "wall"
center_m = [-3.05, 0]
size_m = [0.1, 4]
[[rectangle]]
center_m = [-2.2, 1.4]
size_m = [1.0, 0.6]
[[rectangle]]
center_m = [2.4, -1.0]
size_m = [0.4, 1.2]
)";

constexpr const char* kRobot = R"([robot]
name = "scout"
radius_m = 0.2
[[sensor]]
plugin = "lrf"
beams = 60
fov_deg = 180
max_range_m = 8
[[sensor]]
plugin = "odometry"
[[sensor]]
plugin = "ground_truth"
[mcl]
particles = 4000
)";

}  // namespace

Workspace::Workspace() {
  std::string name = (fs::temp_directory_path() / "ortung-app-XXXXXX").string();
  folder_ = mkdtemp(name.data());
  write("hall.toml", kHall);
  write("robot.toml", kRobot);
}

Workspace::~Workspace() { fs::remove_all(folder_); }

void Workspace::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string Workspace::read(const std::string& name) const {
  std::ifstream in(path(name), std::ios::binary);
  EXPECT_TRUE(in.good()) << name;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> Workspace::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void Workspace::replace(const std::string& name, const std::string& from,
                        const std::string& to) const {
  std::string text = read(name);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  write(name, text.replace(at, from.size(), to));
}

void Workspace::learnTables() const {
  const Outcome outcome =
      ortung({"learn", "--world", path("hall.toml"), "--robot", path("robot.toml"), "--out",
              path("hall.ortung"), "--heading-step", "4"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
}

void Workspace::recordRun() const {
  const Outcome outcome = ortung({"import", "sim", path("hall.toml"), "--out", path("run.txt"),
                                  "--option", "duration=20", "--option", "seed=3", "--option",
                                  "start=0,0,30", "--with-robot", path("robot.toml")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  std::filesystem::rename(path("run.txt"), path("run.rec"));
}

void expectRefused(const Outcome& outcome, int exitCode, const std::string& begin,
                   const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with(begin)) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& part : parts) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
  }
  EXPECT_EQ(outcome.out, "");
}

}  // namespace ortung::test

// The team footballer-v1 is frozen: whatever it is shown, it does what it did when it was new.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include "Files.hpp"
#include "PlainStage.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {
namespace {

std::uint64_t hashOf(const std::string& text) {  // FNV-1a
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return hash;
}

/// What a player does for ten seconds. Its robot goes exactly as it is told, and takes the ball
/// along that it has; another one goes to and fro. The ball is elsewhere after six seconds, near
/// the robot's own goal.
std::string actionsOf(const std::string& plugin, const Parameters& options, std::uint64_t seed) {
  PluginFactory factory(PluginFactory::standardFolders());
  const auto player = factory.make<Player>(plugin, options);
  test::Play play(seed);
  const double shift = static_cast<double>(seed);
  play.stands.balls[0].pose = {1.5 * std::sin(shift), 1.5 * std::cos(shift), 0.0};
  play.seat.able.radius = 0.36;
  play.seat.able.limits = {1.5, 4.0, 2.0, 15.0};
  play.seat.able.manipulators = {{"kicker", {"rest", "kick", "pass"}}};
  player->begin(play.seat);
  for (int i = 0; i < 250; ++i) {
    play.stands.time = i * 40'000;
    if (i == 150) play.stands.balls[0].pose = {5.6 + 0.02 * shift, std::sin(shift), 0.0};
    play.stands.all[1].pose.y = 0.7 * std::sin(0.05 * i + shift);
    const std::size_t before = play.notes.text.size();
    EXPECT_TRUE(player->senseAndAct(play.seat));
    double v = 0.0;
    double w = 0.0;
    const std::string told = play.notes.text.substr(before);
    if (const auto at = told.rfind("v "); at != told.npos)
      std::sscanf(told.c_str() + at, "v %lf", &v);
    if (const auto at = told.rfind("w "); at != told.npos)
      std::sscanf(told.c_str() + at, "w %lf", &w);
    Pose2& pose = play.stands.all[0].pose;
    const Pose2 ball = inverse(pose) * play.stands.balls[0].pose;
    const bool has = ball.x > 0.1 && ball.x < 0.35 && std::abs(ball.y) < 0.1;
    pose = pose * Pose2{0.04 * v, 0.0, 0.04 * w};
    if (has) play.stands.balls[0].pose = pose * Pose2{0.28, 0.0, 0.0};
  }
  return play.notes.text;
}

TEST(FrozenTeam, DoesWhatItDidWhenItWasNew) {
  Parameters sizes;
  sizes.set("length_m", 12.0), sizes.set("width_m", 8.0), sizes.set("goal_width_m", 2.0);
  Parameters out;
  out.set("comes_out_m", 1.6);
  std::string field;
  std::string goal;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    field += actionsOf("footballer-v1", Parameters(sizes), seed);
    goal += actionsOf("goalkeeper-v1", Parameters(out), seed);
  }
  EXPECT_NE(field.find("kicker kick"), field.npos) << "it has done all that it can";
  EXPECT_EQ(hashOf(field), 16036519585857604695U)
      << "footballer-v1 is frozen: mend the change, never this number";
  EXPECT_EQ(hashOf(goal), 10097407167941499499U)
      << "goalkeeper-v1 is frozen: mend the change, never this number";
}

// Their robots are part of the team.
TEST(FrozenTeam, HasTheRobotsThatItHadWhenItWasNew) {
  std::string figures;
  for (const char* robot :
       {"f2000_player.toml", "msl_omni.toml", "goalkeeper.toml", "goalkeeper_lrf.toml"}) {
    std::istringstream lines(test::readBytes(shippedFile("robots", robot)));
    for (std::string line; std::getline(lines, line);)
      if (!line.starts_with('#')) figures += line + "\n";
  }
  EXPECT_EQ(hashOf(figures), 2647200079435591325U) << "give another team robot files of its own";
}

// It shares no source with the players of today, which change.
TEST(FrozenTeam, IncludesItsOwnFilesAlone) {
  const std::filesystem::path folder = FROZEN_TEAM;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    std::istringstream lines(test::readBytes(file.path()));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("#include \"") || line.starts_with("#include \"ortung/")) continue;
      const std::string name = line.substr(10, line.find('"', 10) - 10);
      EXPECT_TRUE(exists(folder / name)) << file.path() << ": " << line;
    }
  }
}

}  // namespace
}  // namespace ortung

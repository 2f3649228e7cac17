// The striker yardstick-v1 is frozen: whatever it is shown, it does what it did when it was new.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "Files.hpp"
#include "PlainStage.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {
namespace {

// The robot goes exactly as it is told, the keeper to and fro.
std::string actionsOf(std::uint64_t seed) {
  PluginFactory factory(PluginFactory::standardFolders());
  Parameters options;
  options.set("kind", "yardstick-v1");
  const auto player = factory.make<Player>("striker", options);
  test::Play play(seed);
  player->begin(play.seat);
  for (int i = 0; i < 200; ++i) {
    play.stands.time = i * 20'000;
    play.stands.all[1].pose.y = 0.7 * std::sin(0.05 * i + static_cast<double>(seed));
    const std::size_t before = play.notes.text.size();
    EXPECT_TRUE(player->senseAndAct(play.seat));
    double v = 0.0;
    double w = 0.0;
    const std::string told = play.notes.text.substr(before);
    std::sscanf(told.substr(told.find("v ")).c_str(), "v %lf\nw %lf", &v, &w);
    play.stands.all[0].pose = play.stands.all[0].pose * Pose2{0.02 * v, 0.0, 0.02 * w};
  }
  return play.notes.text;
}

std::uint64_t hashOf(const std::string& text) {  // FNV-1a
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return hash;
}

TEST(Yardstick, DoesWhatItDidWhenItWasNew) {
  std::string all;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) all += actionsOf(seed);
  EXPECT_EQ(hashOf(all), 3119608592110242418U)
      << "yardstick-v1 is frozen: mend the change, never this number";
}

// Its robot is part of it: where its kicker is, how hard it kicks.
TEST(Yardstick, HasTheRobotThatItHadWhenItWasNew) {
  std::string figures;
  std::istringstream lines(test::readBytes(shippedFile("robots", "striker.toml")));
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) figures += line + "\n";
  EXPECT_EQ(hashOf(figures), 8636493038571426545U)
      << "give another striker a robot file of its own";
}

TEST(Yardstick, KicksOnce) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string told = actionsOf(seed);
    const std::size_t kick = told.find("kicker kick");
    ASSERT_NE(kick, told.npos) << seed;
    EXPECT_EQ(told.find("kicker kick", kick + 1), told.npos) << seed;
  }
}

}  // namespace
}  // namespace ortung

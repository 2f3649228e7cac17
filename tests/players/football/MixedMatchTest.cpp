// Footballers of a team, some in the simulator and some as clients of it, in lockstep.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Files.hpp"
#include "Paths.hpp"
#include "Program.hpp"

namespace ortung::test {
namespace {

const std::string kMaps = ORTUNG_SOURCE_DIR "/maps";

/// Two against two with keepers; one footballer of each team comes as a client.
std::string scene() {
  std::string text = "[scene]\nworld = \"" + kMaps + "/fields/f2000.toml\"\n" +
                     "[referee]\nplugin = \"soccer\"\noptions = { rules = \"f2000\" }\n";
  const auto player = [&](const std::string& team, int number, const std::string& plugin,
                          const std::string& robot, const std::string& start) {
    text += "[[player]]\nplugin = \"" + plugin + "\"\nteam = \"" + team + "\"\nname = \"" + team +
            std::to_string(number) + "\"\nrobot = \"" + kMaps + "/robots/" + robot +
            ".toml\"\nstart = { " + start + " }\n";
  };
  player("blue", 1, "goalkeeper", "goalkeeper", "x_m = -5.5, y_m = 0, theta_deg = 90");
  player("blue", 2, "footballer", "f2000_player", "x_m = -3, y_m = 1.6");
  player("yellow", 1, "goalkeeper", "goalkeeper", "x_m = 5.5, y_m = 0, theta_deg = 90");
  player("yellow", 2, "footballer", "f2000_player", "x_m = 3, y_m = 1.6, theta_deg = 180");
  return text;
}

/// It comes anywhere: in lockstep the world goes on as soon as the first client is there.
std::vector<std::string> client(const std::string& team, const std::string& address) {
  return {"play",
          "footballer:sees=features&robot=f2000_player.toml&length_m=12&width_m=8&goal_width_m=2&"
          "name=" +
              team + "3@" + team,
          "--server",
          address,
          "--lockstep",
          "--duration",
          "40"};
}

/// Returns the length of a body's way [m] by a trace, whose lines tell its x and y behind its name.
double wayOf(const std::string& name, const std::string& trace) {
  double way = 0.0;
  std::optional<std::array<double, 2>> before;
  for (std::size_t at = trace.find(name); at != trace.npos; at = trace.find(name, at + 1)) {
    const std::size_t x = trace.find(',', at) + 1;
    const std::size_t y = trace.find(',', x) + 1;
    const std::array place{std::stod(trace.substr(x, 10)), std::stod(trace.substr(y, 10))};
    if (before) way += std::hypot(place[0] - (*before)[0], place[1] - (*before)[1]);
    before = place;
  }
  return way;
}

TEST(MixedMatch, IsPlayedByTheRules) {
  const TemporaryFolder folder;
  writeBytes(folder / "scene.toml", scene());
  Program server({"sim", folder / "scene.toml", "--listen", "0", "--lockstep", "--trace",
                  folder / "trace.csv"});
  const std::string out = server.waitForOutput("\n");
  const std::string address = "127.0.0.1:" + out.substr(out.find("port ") + 5, 5);
  Program blue(client("blue", address.substr(0, address.find('\n'))));
  Program yellow(client("yellow", address.substr(0, address.find('\n'))));
  const Outcome one = blue.finish();
  const Outcome other = yellow.finish();
  EXPECT_EQ(one.exitCode, 0) << one.err;
  EXPECT_EQ(other.exitCode, 0) << other.err;
  server.signal(SIGTERM);
  const Outcome outcome = server.finish();
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("kick-off blue: a half begins"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("play blue: the ball is in play"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.err.find("player"), std::string::npos) << outcome.err;
  // Those who came as clients have played, wherever the ball was: nobody is pushed as far as this.
  const std::string trace = readBytes(folder / "trace.csv");
  for (const char* name : {"blue3", "yellow3"}) EXPECT_GT(wayOf(name, trace), 5.0) << name;
}

}  // namespace
}  // namespace ortung::test

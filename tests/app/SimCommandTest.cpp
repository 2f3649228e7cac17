// What `ortung sim` simulates, and the files that it leaves.
#include <csignal>
#include <regex>
#include <set>
#include <sstream>

#include "Workspace.hpp"
#include "ortung/records/RecordSource.hpp"

namespace ortung::test {
namespace {

class SimCommand : public Workspace {
 protected:
  Outcome sim(const std::vector<std::string>& more) const {
    std::vector<std::string> command = {"sim", path("hall.toml"), "--free-run"};
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  }
  std::vector<Message> readingsOf(const std::string& name) const {
    RecordSource source(path(name));
    std::vector<Message> all;
    for (Message message; source.next(message);) all.push_back(message);
    return all;
  }
  /// The columns of a trace's lines, without its head.
  std::vector<std::vector<std::string>> trace() const {
    std::vector<std::vector<std::string>> lines;
    std::istringstream in(read("trace.csv"));
    for (std::string line; std::getline(in, line);) {
      lines.emplace_back();
      std::istringstream words(line);
      for (std::string word; std::getline(words, word, ',');) lines.back().push_back(word);
    }
    EXPECT_FALSE(lines.empty());
    if (!lines.empty()) lines.erase(lines.begin());
    return lines;
  }
};

// Cycles begin at 0; the last one is that of the duration.
TEST_F(SimCommand, RunsForItsDurationInCyclesOfTheGivenLength) {
  const auto expectCycles = [&](const std::vector<std::string>& more, const std::string& begin) {
    const Outcome outcome = sim(more);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(std::regex_match(outcome.out, std::regex(begin + ", [0-9]+ times real time\n")))
        << outcome.out;
  };
  expectCycles({"--duration", "0.5"}, "hall: 0.51 s in 51 cycles, 0 robots");
  expectCycles({"--duration", "0.5", "--cycle-ms", "100", "--robot", path("robot.toml")},
               "hall: 0.60 s in 6 cycles, 1 robots");
  expectCycles({"--duration", "0", "--robot", path("robot.toml"), "--robot", path("robot.toml")},
               "hall: 0.01 s in 1 cycles, 2 robots");
}

// Whoever has the first address may control, with the token of this run; who has the second looks.
TEST_F(SimCommand, ViewersGetTheAddressAtWhichItListens) {
  const auto expectAddress = [&](const std::vector<std::string>& more, const std::string& host,
                                 const std::string& last) {
    std::vector<std::string> command = {"sim", path("hall.toml"), "--view", "--no-browser"};
    command.insert(command.end(), more.begin(), more.end());
    Program program(command);
    program.waitForOutput("view and control");
    program.signal(SIGINT);
    const Outcome outcome = program.finish();
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    std::smatch found;
    const std::regex form("listening on (.*) port ([0-9]+)\nview and control: http://" + host +
                          ":([0-9]+)/" + last + "(.*\n)*");
    ASSERT_TRUE(std::regex_match(outcome.out, found, form)) << outcome.out;
    EXPECT_EQ(found[1], more[1].substr(0, more[1].rfind(':')));
    EXPECT_EQ(found[2], found[3]);
  };
  const std::string token = "#token=[0-9a-f]{32}\n";
  expectAddress({"--listen", "127.0.0.1:0"}, "127.0.0.1",
                token + "view only:        http://127.0.0.1:[0-9]+/\n");
  write("tokens", "* 12345678\n");
  expectAddress({"--listen", "0.0.0.0:0", "--token-file", path("tokens")}, "localhost", token);
  write("tokens", "view 12345678\n");
  expectAddress({"--listen", "0.0.0.0:0", "--token-file", path("tokens")}, "localhost", "\n");
}

TEST_F(SimCommand, TracesHaveAllBodiesTwentyTimesASecond) {
  ASSERT_EQ(sim({"--duration", "0.5", "--robot", path("robot.toml"), "--robot", path("robot.toml"),
                 "--robot", path("robot.toml"), "--trace", path("trace.csv")})
                .exitCode,
            0);
  std::map<std::string, std::vector<std::string>> times;
  for (const auto& line : trace()) {
    ASSERT_GE(line.size(), 9u);
    EXPECT_EQ(line[1], "robot");
    times[line[2]].push_back(line[0]);
  }
  ASSERT_EQ(times.size(), 3u);
  std::vector<std::string> expected;
  for (int i = 0; i <= 10; ++i) {
    const std::string hundredths = std::to_string(5 * i);
    expected.push_back("0." + std::string(2 - hundredths.size(), '0') + hundredths + "0");
  }
  for (const char* name : {"scout", "scout-2", "scout-3"}) EXPECT_EQ(times[name], expected) << name;
}

TEST_F(SimCommand, RecordsTheFirstRobotOrTheNamedOne) {
  const auto positionOf = [&](const std::string& robot) {
    for (const auto& line : trace())
      if (line[2] == robot) return std::stod(line[3]);
    return -99.0;
  };
  for (const std::string robot : {"", "scout-2"}) {
    std::vector<std::string> more = {
        "--duration",       "0.3",      "--robot",       path("robot.toml"), "--robot",
        path("robot.toml"), "--record", path("run.rec"), "--trace",          path("trace.csv")};
    if (!robot.empty()) more.insert(more.end(), {"--recorded", robot});
    const Outcome outcome = sim(more);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::vector<Message> readings = readingsOf("run.rec");
    const std::string name = robot.empty() ? "scout" : robot;
    EXPECT_NE(outcome.out.find("; " + std::to_string(readings.size()) + " readings of " + name +
                               " in " + path("run.rec") + "\n"),
              std::string::npos)
        << outcome.out;
    // The ground truth is in whole millimetres above -2^31, and some time later than the trace's
    // first line.
    for (const Message& message : readings) {
      if (message.id.type != "groundTruth") continue;
      EXPECT_NEAR((message.words[0] - 2147483648.0) / 1e3, positionOf(name), 0.05);
      break;
    }
  }
}

TEST_F(SimCommand, ASceneEndsByItself) {
  write("scene.toml",
        "[scene]\nworld = \"hall.toml\"\nduration_s = 0.2\n[[robot]]\nfile = \"robot.toml\"\n"
        "name = \"anna\"\nstart = { x_m = 0, y_m = 0, theta_deg = 0 }\n");
  const auto lengthOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command = {"sim", path("scene.toml"), "--free-run"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = ortung(command);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return outcome.out.substr(0, outcome.out.find(" s in"));
  };
  EXPECT_EQ(lengthOf({}), "hall: 0.21");
  EXPECT_EQ(lengthOf({"--duration", "0.1"}), "hall: 0.11");
}

TEST_F(SimCommand, TooManyRobotsAreRefusedWithTheirNumber) {
  std::vector<std::string> more = {"--duration", "0"};
  for (int i = 0; i < 257; ++i) more.insert(more.end(), {"--robot", path("robot.toml")});
  expectRefused(sim(more), 2,
                "ortung sim: there are 257 robots, 257 of them by --robot and --player",
                {"expected at most 256"});
}

TEST_F(SimCommand, APlayerThatFailsIsSaidAndEndsWithCode1) {
  const Outcome outcome =
      sim({"--duration", "0.1", "--player",
           "wander:robot=" + path("robot.toml") + "&start=0,0,0&speed_m_s=fast"});
  EXPECT_EQ(outcome.exitCode, 1) << outcome.out;
  EXPECT_NE(outcome.err.find("speed_m_s"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace ortung::test

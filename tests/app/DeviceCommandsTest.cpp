// Commands of real robots: options that need each other, no device where one should be, and what
// can't be emulated.
#include <csignal>
#include <cstdint>
#include <optional>
#include <regex>
#include <sstream>

#include "Await.hpp"
#include "TestClient.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

using Words = std::vector<std::string>;

class DeviceCommands : public Workspace {
 protected:
  /// Expects wrong usage, which is said before anything is written.
  void expectWrong(const Words& command, const std::string& more) const {
    const Words before = files();
    const std::string name =
        "ortung " + command[0] + (command[0] == "calibrate" ? " " + command[1] : "");
    expectRefused(ortung(command), 2, name + ": ", {more});
    EXPECT_EQ(files(), before);
  }
  void writeRobot(const std::string& sensors) const {
    write("robot.toml", "[robot]\nname = \"scout\"\nradius_m = 0.2\n" + sensors);
  }
  Words emulate(const Words& more) const {
    Words command = {"emulate", "--robot", path("robot.toml")};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  Words emulateInHall(const Words& more) const {
    Words command = emulate({"--world", path("hall.toml")});
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
};

constexpr const char* kScanner =
    "[[sensor]]\nplugin = \"lrf\"\nbeams = 181\nfov_deg = 180\n"
    "device = { plugin = \"sick_lms\", port = \"/dev/scanner\" }\n";
constexpr const char* kOdometry = "[[sensor]]\nplugin = \"odometry\"\n";

TEST_F(DeviceCommands, ARobotNeedsClientsOrTablesForSomeOptions) {
  expectWrong({"robot", path("robot.toml"), "--allow-control", "all"},
              "--allow-control and --token-file are for --listen and --view");
  expectWrong({"robot", path("robot.toml"), "--token-file", path("tokens")},
              "--allow-control and --token-file are for --listen and --view");
  expectWrong({"robot", path("robot.toml"), "--out", path("poses.txt")}, "--out needs --tables");
}

TEST_F(DeviceCommands, AnEmulatorNeedsOneSourceAndSomeOptionsOneDevice) {
  expectWrong(emulate({}), "expected one of --world and --source");
  expectWrong(emulate({"--world", path("hall.toml"), "--source", "record:x"}),
              "expected one of --world and --source");
  expectWrong(emulate({"--source", "run.rec"}), "expected KIND:PATH");
  writeRobot(
      std::string(kScanner) +
      "[[sensor]]\nplugin = \"odometry\"\ndevice = { plugin = \"base\", port = \"/dev/base\" "
      "}\n");
  for (const Words& one :
       {Words{"--link", path("x")}, Words{"--tcp", "0"}, Words{"--baud", "9600"}})
    expectWrong(emulateInHall(one), "--link, --tcp and --baud are for a single device");
}

// A clock that is a tenth too fast tells 1.1 s of each second, from what it showed at the start on.
TEST_F(DeviceCommands, ClocksOfEmulatedDevicesShowAnotherTimeAndDrift) {
  writeRobot(std::string(kOdometry) + "device = { plugin = \"lines\", port = \"/dev/base\" }\n");
  std::string record = "# ortung record 1\n";
  for (int i = 0; i < 30'000; ++i)  // x is the number of the reading
    record += std::to_string(7'000'000 + 20'000 * i) + " odometry/odometry/pose 5 " +
              std::to_string(0x80000000U + static_cast<unsigned>(i)) +
              " 2147483648 18000 2147483648 2147483648\n";
  write("run.rec", record);
  Program emulator(emulate({"--source", "record:" + path("run.rec"), "--tcp", "0", "--speed", "10",
                            "--clock-offset", "5000", "--clock-drift-ppm", "100000"}));
  const std::string said = emulator.waitForOutput("\n");
  const std::size_t colon = said.rfind(':');
  ASSERT_NE(colon, said.npos) << said;
  TestClient client(static_cast<std::uint16_t>(std::stoi(said.substr(colon + 1))));
  std::optional<std::int64_t> began;
  for (int lines = 0; lines < 50; ++lines) {
    std::istringstream words(client.line());
    std::int64_t stamp = 0;
    std::string feature;
    std::size_t count = 0;
    std::uint32_t x = 0;
    ASSERT_TRUE(words >> stamp >> feature >> count >> x) << words.str();
    // The readings begin a moment after the clock.
    const std::int64_t offset = stamp - 22'000 * (x - 0x80000000U);
    if (!began) began = offset;
    EXPECT_NEAR(static_cast<double>(offset), static_cast<double>(*began), 1.0) << "rounded";
  }
  EXPECT_GE(*began, 5'000'000'000);
  EXPECT_LT(*began, 6'000'000'000);
  emulator.signal(SIGTERM);
  EXPECT_EQ(emulator.finish().exitCode, 0);
}

/// What is said by a program that listens: its port.
std::string portOf(const std::string& said, char before) {
  const std::size_t at = said.find_first_of("0123456789", said.rfind(before));
  EXPECT_NE(at, said.npos) << said;
  return at == said.npos ? "0" : std::to_string(std::stoi(said.substr(at)));
}

TEST_F(DeviceCommands, ClientsOfARobotRecordWhatItsDevicesSay) {
  const std::string device = "device = { plugin = \"lines\", port = \"tcp:127.0.0.1:@\" }\n";
  writeRobot(std::string(kOdometry) + device);
  std::string record = "# ortung record 1\n";
  for (int i = 0; i < 30'000; ++i)
    record += std::to_string(20'000 * i) +
              " odometry/odometry/pose 5 2147483648 2147483648 18000 2147483648 2147483648\n";
  write("run.rec", record);
  Program emulator(emulate({"--source", "record:" + path("run.rec"), "--tcp", "0"}));
  replace("robot.toml", "@", portOf(emulator.waitForOutput("\n"), ':'));
  std::filesystem::create_directory(path("records"));
  Program robot({"robot", path("robot.toml"), "--listen", "0", "--allow-control", "all",
                 "--record-into", path("records")});
  TestClient client(static_cast<std::uint16_t>(std::stoi(portOf(robot.waitForOutput("\n"), 'p'))));
  client.ask("HELLO ortung/1 role=operator");
  const std::string begun = client.ask("RECORD on");
  ASSERT_TRUE(begun.starts_with("OK RECORD robot=1 state=on file=")) << begun;
  EXPECT_TRUE(comesTrue("five moments are recorded",
                        [&] { return std::stoi(valueOf(client.ask("RECORD"), "moments")) >= 5; }));
  const std::string ended = client.ask("RECORD off");
  EXPECT_TRUE(ended.starts_with("OK RECORD robot=1 state=off file=")) << ended;
  const Outcome good = ortung({"check", path("records/" + valueOf(ended, "file"))});
  EXPECT_EQ(good.exitCode, 0) << good.err;
  robot.signal(SIGTERM);
  EXPECT_EQ(robot.finish().exitCode, 0);
}

TEST_F(DeviceCommands, ABoardHasTwoNumbers) {
  for (const char* board : {"9", "9x", "x6", "9x6x2", "2x6", "9x2", "101x6", "9X6", "9x6 ", "a"})
    expectWrong(
        {"calibrate", "camera", path("none.png"), "--board", board},
        std::string("--board is '") + board + "', expected two numbers of 3 to 100, as 9x6");
}

TEST_F(DeviceCommands, ADeviceThatIsNotThereStandsInTheTableWithoutReadings) {
  writeRobot(std::string(kScanner) + kOdometry);
  std::filesystem::create_directory(path("dev"));
  // Its thread must have looked for it until then, on a busy machine, too.
  const Outcome outcome = ortung({"robot", path("robot.toml"), "--dev", path("dev"), "--duration",
                                  "2", "--record", path("run.rec")});
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("ortung robot: sick_lms /dev/scanner: "), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("ortung robot: " + path("robot.toml") +
                             ": no device gave a reading: sick_lms /dev/scanner ("),
            std::string::npos)
      << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("device ")) << outcome.out;
  EXPECT_TRUE(std::regex_search(outcome.out,
                                std::regex("\nsick_lms /dev/scanner +[a-z]+ +0\\.0 +- +0 +- ")))
      << outcome.out;
  EXPECT_TRUE(outcome.out.ends_with(path("run.rec") + ": 0 readings\n")) << outcome.out;
  EXPECT_EQ(outcome.out.find("updates of the pose"), std::string::npos);
}

TEST_F(DeviceCommands, ARobotFileWithoutDevicesIsRefused) {
  writeRobot(kOdometry);
  const Outcome outcome = ortung({"robot", path("robot.toml"), "--duration", "0.1"});
  EXPECT_EQ(outcome.exitCode, 1) << outcome.out;
  EXPECT_NE(outcome.err.find("device"), std::string::npos) << outcome.err;
}

TEST_F(DeviceCommands, WhatCanNotBeEmulatedIsSaid) {
  writeRobot(kOdometry);
  expectRefused(
      ortung(emulateInHall({})), 1,
      "ortung emulate: " + path("robot.toml") + ": names no device that could be emulated", {});
  expectRefused(ortung(emulateInHall({"sick"})), 1,
                "ortung emulate: the robot file has no scan that a sick", {"plugin = \"lrf\""});
  expectRefused(ortung(emulateInHall({"hokuyo"})), 1,
                "ortung emulate: the robot file has no scan that a hokuyo", {});
  writeRobot(kScanner);
  expectRefused(
      ortung(emulateInHall({"base"})), 1,
      "ortung emulate: " + path("robot.toml") + ": names no device that could be emulated", {});
}

TEST_F(DeviceCommands, WrongFaultsAreWrongUsageButOnlyThoseOfTheDevice) {
  writeRobot(kScanner);
  const Outcome outcome =
      ortung(emulateInHall({"--fault", "base=nonsense", "--fault", "sick=nonsense"}));
  EXPECT_EQ(outcome.exitCode, 2) << outcome.out;
  EXPECT_TRUE(outcome.err.starts_with("ortung emulate: --fault: ")) << outcome.err;
  EXPECT_NE(outcome.err.find("nonsense"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace ortung::test

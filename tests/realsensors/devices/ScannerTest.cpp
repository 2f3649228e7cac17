#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>

#include "Desk.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/emulators/EmulatedHokuyo.hpp"
#include "ortung/emulators/EmulatedSick.hpp"
#include "ortung/formats/ScanData.hpp"

// MRPT's own drivers on one side, the emulated scanners on the other: neither knows the other's
// code.
namespace ortung {
namespace {

const SensorId kScan{"LMS200", "LRF", "180DegreeScan"};

ScanData::Config geometry(int beams, double first, double step) {
  ScanData::Config config;
  config.beams = beams;
  config.firstAngle = radians(first);
  config.angleStep = radians(step);
  config.maxRange = 8.0;
  return config;
}

/// Every beam another range; some invalid, some without an echo. Each scan another one.
std::vector<std::uint32_t> scanAt(std::size_t n, int beams) {
  Random random(n, 7);
  std::vector<std::uint32_t> words;
  for (int i = 0; i < beams; ++i) {
    const double kind = random.uniform();
    words.push_back(kind < 0.1   ? 0U
                    : kind < 0.2 ? 8001U
                                 : static_cast<std::uint32_t>(random.uniform(100.0, 7990.0)));
  }
  return words;
}

/// What the program that holds MRPT's drivers says to such words.
std::string answerTo(const std::string& words) {
  const std::filesystem::path folder = std::filesystem::path(ORTUNG_PROGRAM).parent_path();
  const std::string command = (folder / "ortung-mrpt-device").string() + " " + words;
  std::string said;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 256> text{};
  while (pipe && std::fgets(text.data(), text.size(), pipe.get())) said += text.data();
  return said;
}

TEST(ScannerProgram, SaysHowItIsUsedToWhoeverDoesNotKnow) {
  for (const char* words : {"", "hokuyo", "sick /dev/null", "hokyuo /dev/null",
                            "hokuyo /dev/null 2", "slick /dev/null 9600 180 1 mm"})
    EXPECT_TRUE(answerTo(words).starts_with("# error usage: ortung-mrpt-device sick PORT"))
        << words << ": " << answerTo(words);
}

struct DeskOfScanner : testing::Test {
  void put(const ScanData::Config& config) {
    beams = config.beams;
    scan = std::make_unique<ScanData>(kScan, Pose2{}, config);
    source = std::make_unique<test::Rehearsed>(std::vector<test::Rehearsed::Part>{
        {kScan, [this](std::size_t n) { return scanAt(n, beams); }}});
    desk = std::make_unique<test::Desk>(*source);
  }
  std::unique_ptr<Endpoint> line() const {
    return std::make_unique<PseudoTerminal>(desk->dev() / "laser");
  }
  static std::string robot(const std::string& beams, const std::string& device) {
    return "[[sensor]]\nplugin = 'lrf'\n" + beams + "\ndevice = { " + device + " }\n";
  }
  /// @param unit what the scanner rounds to [mm]
  void expectAsGiven(const std::vector<Message>& messages, std::uint32_t unit = 1) {
    const auto given = source->given(kScan);
    for (const Message& message : messages) {
      const bool isThere = std::any_of(given.begin(), given.end(), [&](const auto& words) {
        return std::equal(words.begin(), words.end(), message.words.begin(), message.words.end(),
                          [&](std::uint32_t a, std::uint32_t b) {
                            if (a == 0 || b == 0 || a > 8000 || b > 8000) return a == b;
                            return std::max(a, b) - std::min(a, b) <= unit / 2;
                          });
      });
      EXPECT_TRUE(isThere);
    }
  }
  int beams = 0;
  std::unique_ptr<ScanData> scan;
  std::unique_ptr<test::Rehearsed> source;
  std::unique_ptr<test::Desk> desk;
};

using SickTest = DeskOfScanner;
using HokuyoTest = DeskOfScanner;

TEST_F(SickTest, MeasuresThroughMrptsDriver) {
  put(geometry(181, -90, 1));
  desk->add(std::make_unique<EmulatedSick>(*scan), line());
  DevicesSource& devices = desk->start(robot(
      "beams = 181\nfov_deg = 180", "plugin = 'sick_lms', port = '/dev/laser', baud = 38400"));
  expectAsGiven(desk->read(kScan, 10));
  EXPECT_EQ(devices.status()[0].refused, 0U);
  EXPECT_FALSE(devices.status()[0].driftPpm);  // it has no clock
}

TEST_F(SickTest, MeasuresHalfDegreesInCentimetres) {
  put(geometry(361, -90, 0.5));
  desk->add(std::make_unique<EmulatedSick>(*scan, 38400), line());
  desk->start(robot("beams = 361\nfov_deg = 180",
                    "plugin = 'sick_lms', port = '/dev/laser', baud = 500000, step_deg = 0.5, "
                    "unit = 'cm'"));
  expectAsGiven(desk->read(kScan, 10), 10);
}

TEST_F(SickTest, IsFoundAgainWhenItWasUnplugged) {
  put(geometry(181, -90, 1));
  desk->add(std::make_unique<EmulatedSick>(*scan), line(), test::againAndAgain("unplug", 1));
  desk->start(robot("beams = 181\nfov_deg = 180",
                    "plugin = 'sick_lms', port = '/dev/laser', baud = 38400"));
  desk->readUntil(0, [](const DeviceStatus& status) { return status.openings >= 2; });
  expectAsGiven(desk->read(kScan, 5));
}

TEST_F(SickTest, GarbageReachesNobody) {
  put(geometry(181, -90, 1));
  desk->add(std::make_unique<EmulatedSick>(*scan), line(), {"garbage@0.5-3", "half@3-5"});
  desk->start(robot("beams = 181\nfov_deg = 180",
                    "plugin = 'sick_lms', port = '/dev/laser', baud = 38400"));
  expectAsGiven(desk->read(kScan, 25));
}

TEST_F(SickTest, OfOtherBeamsIsAMisfit) {
  put(geometry(181, -90, 1));
  desk->add(std::make_unique<EmulatedSick>(*scan), line());
  DevicesSource& devices = desk->start(robot(
      "beams = 180\nfov_deg = 180", "plugin = 'sick_lms', port = '/dev/laser', baud = 38400"));
  desk->readUntil(0,
                  [](const DeviceStatus& status) { return status.state == DeviceState::kFailed; });
  const std::string reason = devices.status()[0].reason;
  EXPECT_NE(reason.find("gives 181 beams from -90"), std::string::npos) << reason;
  EXPECT_NE(reason.find("the robot file says 180"), std::string::npos) << reason;
}

TEST_F(SickTest, FrozenIsNotUsed) {
  put(geometry(181, -90, 1));
  desk->add(std::make_unique<EmulatedSick>(*scan), line(), test::againAndAgain("freeze", 3));
  desk->start(robot("beams = 181\nfov_deg = 180",
                    "plugin = 'sick_lms', port = '/dev/laser', baud = 38400"));
  desk->readUntil(0,
                  [](const DeviceStatus& status) { return status.state == DeviceState::kFrozen; });
  desk->readUntil(0,
                  [](const DeviceStatus& status) { return status.state == DeviceState::kRunning; });
}

TEST(SickChecksum, IsThatOfSicksOwnTelegrams) {
  // Examples of SICK's list of telegrams: "monitoring mode, continuous" and the answer's header.
  const std::string start{'\x02', '\x00', '\x02', '\x00', '\x20', '\x24'};
  EXPECT_EQ(sickChecksum(start), 0x0834);
  const std::string stop{'\x02', '\x00', '\x02', '\x00', '\x20', '\x25'};
  EXPECT_EQ(sickChecksum(stop), 0x0835);
  // That with the password, as MRPT's source quotes it: ... BE C5.
  std::string install{'\x02', '\x00', '\x0A', '\x00', '\x20', '\x00'};
  install += "SICK_LMS";
  EXPECT_EQ(sickChecksum(install), 0xC5BE);
}

/// As a URG-04LX: 0.3516 degrees, a beam straight ahead.
const std::string kUrg = "beams = 683\nfirst_angle_deg = -119.8828125\nangle_step_deg = 0.3515625";

TEST_F(HokuyoTest, MeasuresThroughMrptsDriverAtASerialPort) {
  put(geometry(683, -119.8828125, 0.3515625));
  desk->add(std::make_unique<EmulatedHokuyo>(*scan), line());
  DevicesSource& devices = desk->start(robot(kUrg, "plugin = 'hokuyo', port = '/dev/laser'"));
  expectAsGiven(desk->read(kScan, 15));
  EXPECT_TRUE(devices.status()[0].driftPpm);  // it has a clock
}

TEST_F(HokuyoTest, MeasuresThroughMrptsDriverAtASocket) {
  put(geometry(1081, -135, 0.25));
  auto end = std::make_unique<TcpEndpoint>(0);
  const std::string port = end->name();
  auto scanner = std::make_unique<EmulatedHokuyo>(*scan);
  scanner->clock.offset = 16'775.0;  // its 24 bits of milliseconds begin anew 2.2 s later
  desk->add(std::move(scanner), std::move(end));
  desk->start(robot("beams = 1081\nfirst_angle_deg = -135\nangle_step_deg = 0.25",
                    "plugin = 'hokuyo', port = '" + port + "'"));
  const auto messages = desk->read(kScan, 40);
  expectAsGiven(messages);
  // Missing the new beginning would shift the time by 16,777 s; a busy computer delays a scan by
  // less than a minute.
  for (std::size_t i = 1; i < messages.size(); ++i)
    EXPECT_LT(messages[i].stamp - messages[i - 1].stamp, 60'000'000);
}

TEST_F(HokuyoTest, IsFoundAgainWhenItWasUnplugged) {
  put(geometry(683, -119.8828125, 0.3515625));
  desk->add(std::make_unique<EmulatedHokuyo>(*scan), line(), test::againAndAgain("unplug", 1));
  desk->start(robot(kUrg, "plugin = 'hokuyo', port = '/dev/laser'"));
  desk->readUntil(0, [](const DeviceStatus& status) { return status.openings >= 2; });
  expectAsGiven(desk->read(kScan, 5));
}

/// Lines of an answer, and their checksums, by hand from the SCIP 2.0 specification.
TEST(EmulatedHokuyo, AnswersAsScipSays) {
  const ScanData scan(kScan, {}, geometry(683, -119.8828125, 0.3515625));
  EmulatedHokuyo hokuyo(scan);
  const auto ask = [&](const std::string& line) {
    hokuyo.receive(line + "\n", 0);
    std::string answer;
    for (const auto& one : hokuyo.takeOutput(0)) answer += one.bytes;
    return answer;
  };
  EXPECT_EQ(ask("BM"), "BM\n00P\n\n");
  EXPECT_EQ(ask("BM"), "BM\n02R\n\n");
  EXPECT_EQ(ask("QT;text"), "QT;text\n00P\n\n");
  EXPECT_EQ(ask("ZZ"), "ZZ\n0Ee\n\n");
  EXPECT_NE(ask("PP").find("ARES:1024;"), std::string::npos);
  EXPECT_NE(ask("PP").find("AFRT:341;"), std::string::npos);
  EXPECT_EQ(ask("MD0000900001000").substr(16, 4), "05U\n");  // steps that it does not have
  EXPECT_EQ(ask("MD0000068201002"), "MD0000068201002\n00P\n\n");
  hokuyo.sense({0, kScan, std::vector<std::uint32_t>(683, 1234)}, 5'000'000);
  const auto sent = hokuyo.takeOutput(5'000'000);
  ASSERT_EQ(sent.size(), 1U);
  // 5000 ms = 0o1_16_10 in sixes of bits: 0, 1, 14, 8; 1234 mm: 0, 19, 18.
  EXPECT_EQ(sent[0].bytes.substr(0, 25), "MD0000068201002\n99b\n01>8G");
  EXPECT_EQ(sent[0].bytes.substr(26, 6), "0CB0CB");
  EXPECT_TRUE(sent[0].bytes.ends_with("\n\n"));
}

TEST(EmulatedScanners, LiveWithWhateverComes) {
  Random random(11);
  const ScanData scan(kScan, {}, geometry(181, -90, 1));
  EmulatedSick sick(scan);
  EmulatedHokuyo hokuyo(ScanData(kScan, {}, geometry(683, -119.8828125, 0.3515625)));
  const std::string starts[] = {"MD",    "\x02", "GS0000", std::string("\x02\x00\x02\x00", 4),
                                "TM1\n", "\n"};
  for (int i = 0; i < 20'000; ++i) {
    std::string bytes = starts[static_cast<std::size_t>(random.uniform(0.0, 5.99))];
    for (int n = 0; n < 12; ++n)
      bytes += static_cast<char>(static_cast<int>(random.uniform(0.0, 256.0)));
    sick.receive(bytes, i);
    hokuyo.receive(bytes, i);
    sick.takeOutput(1'000'000'000);
    hokuyo.takeOutput(1'000'000'000);
  }
  hokuyo.receive("\nQT\n", 20'000);
  bool isAnswered = false;
  for (const auto& one : hokuyo.takeOutput(1'000'000'000)) isAnswered |= one.bytes == "QT\n00P\n\n";
  EXPECT_TRUE(isAnswered);
}

}  // namespace
}  // namespace ortung

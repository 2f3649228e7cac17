#include <gtest/gtest.h>

#include "Desk.hpp"
#include "ortung/emulators/EmulatedBase.hpp"
#include "ortung/emulators/EmulatedLines.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

const SensorId kWheels{"odometry", "odometry", "pose"};
const SensorId kSonar0{"sonar", "ultrasonic", "sonar0"};
const SensorId kSonar1{"sonar", "ultrasonic", "sonar1"};
const SensorId kCompass{"compass", "compass", "north"};

std::vector<std::uint32_t> wheelsAt(std::size_t n) {
  OdometryData::Reading reading;
  reading.pose = {0.013 * static_cast<double>(n), -0.4, 0.01 * static_cast<double>(n % 100)};
  reading.translationalVelocity = 0.13;
  reading.motionData = {static_cast<std::uint32_t>(n), 4294967295U};
  return OdometryData::encode(reading);
}

/// A base with two sonars and something home-made beside it.
struct DeskOfBase : testing::Test {
  DeskOfBase()
      : wheels(kWheels),
        sonar0(kSonar0, {}, {}),
        sonar1(kSonar1, {}, {}),
        compass(kCompass, {}, {}),
        source({{kWheels, wheelsAt},
                {kSonar0, [](std::size_t n) { return words(500 + n); }},
                {kSonar1, [](std::size_t n) { return words(n % 3 == 0 ? 3001 : 900 + n); }},
                {kCompass, [](std::size_t n) { return words(n % 36000); }}}),
        desk(source) {}
  static std::vector<std::uint32_t> words(std::size_t word) {
    return {static_cast<std::uint32_t>(word)};
  }
  std::unique_ptr<EmulatedDevice> base(int baud = 115200) {
    const std::vector<const SensorData*> features{&wheels, &sonar0, &sonar1};
    return std::make_unique<EmulatedBase>(features, baud);
  }
  std::unique_ptr<EmulatedDevice> lines() {
    const std::vector<const SensorData*> features{&compass};
    return std::make_unique<EmulatedLines>(features, 115200);
  }
  std::unique_ptr<Endpoint> line(const std::string& name) {
    return std::make_unique<PseudoTerminal>(desk.dev() / name);
  }
  /// A busy machine may hand readings over late, and those of one device long before another's:
  /// they are used all the same, in order, where tests don't say.
  static std::string robot(const std::string& more = ", stale_after_s = 60, late_after_s = 60") {
    return "[devices]\nwait_s = 5\n[[sensor]]\nplugin = 'odometry'\n"
           "device = { plugin = 'base', port = '/dev/base'" +
           more +
           " }\n"
           "[[sensor]]\nplugin = 'sonar'\nangles_deg = [0, 90]\n"
           "device = { plugin = 'base', port = '/dev/base' }\n";
  }
  static std::string robotWithCompass(
      const std::string& more = ", stale_after_s = 60, late_after_s = 60") {
    return robot(more) +
           "[[sensor]]\nplugin = 'compass'\n"
           "device = { plugin = 'lines', port = '/dev/compass', stale_after_s = 60, "
           "late_after_s = 60 }\n";
  }
  /// Whether words came as they were given, from some reading on, without one left out.
  void expectAsGiven(const std::vector<Message>& messages) {
    const auto given = source.given(messages.front().id);
    auto at = std::find(given.begin(), given.end(), messages.front().words);
    for (const Message& message : messages) {
      ASSERT_NE(at, given.end());
      EXPECT_EQ(message.words, *at++);
    }
  }
  /// Reads on: no reading of the compass is missing since the first one that came meanwhile.
  void expectCompassWentOn(const std::map<std::string, std::vector<Message>>& meanwhile) {
    const auto found = meanwhile.find(toText(kCompass));
    std::vector<Message> messages =
        found == meanwhile.end() ? std::vector<Message>() : found->second;
    for (Message& message : desk.read(kCompass, 5)) messages.push_back(std::move(message));
    expectAsGiven(messages);
  }
  OdometryData wheels;
  ConeData sonar0;
  ConeData sonar1;
  BearingData compass;
  test::Rehearsed source;
  test::Desk desk;
};

using DeskTest = DeskOfBase;

TEST_F(DeskTest, WhatABaseMeasuresArrivesAsItWasMeasured) {
  desk.add(base(), line("base"));
  DevicesSource& devices = desk.start(robot());
  std::map<std::string, std::vector<Message>> messages;
  Timestamp last = 0;
  while (messages[toText(kWheels)].size() < 15) {
    Message message;
    ASSERT_TRUE(devices.next(message));
    EXPECT_GE(message.stamp, last);
    last = message.stamp;
    messages[toText(message.id)].push_back(message);
  }
  for (const auto& id : {kWheels, kSonar0, kSonar1}) expectAsGiven(messages[toText(id)]);
  // One moment of the base is one moment of the robot.
  EXPECT_EQ(messages[toText(kSonar0)][3].stamp, messages[toText(kWheels)][3].stamp);
  const DeviceStatus status = devices.status()[0];
  EXPECT_EQ(status.state, DeviceState::kRunning);
  EXPECT_EQ(status.refused, 0U);
  EXPECT_EQ(status.name, "base /dev/base");
}

TEST_F(DeskTest, ABaseMayAsWellBeAServer) {
  auto end = std::make_unique<TcpEndpoint>(0);
  const std::string port = end->name();
  desk.add(base(), std::move(end));
  std::string file = robot();
  for (std::size_t at = file.find("/dev/base"); at != std::string::npos;
       at = file.find("/dev/base"))
    file.replace(at, 9, port);
  desk.start(file);
  expectAsGiven(desk.read(kWheels, 10));
}

TEST_F(DeskTest, HomeMadeDevicesSendLinesOfRecords) {
  desk.add(base(), line("base"));
  desk.add(lines(), line("compass"));
  desk.start(robotWithCompass());
  expectAsGiven(desk.read(kCompass, 10));
}

TEST_F(DeskTest, ADeviceThatIsAbsentAtTheStartIsFoundLater) {
  desk.add(base(), line("base"), {"unplug@0-5"});
  desk.add(lines(), line("compass"));
  DevicesSource& devices = desk.start(robotWithCompass(), false);
  const auto meanwhile = desk.readUntil(
      0, [](const DeviceStatus& status) { return status.state == DeviceState::kAbsent; });
  EXPECT_NE(devices.status()[0].reason.find("base"), std::string::npos);
  expectAsGiven(desk.read(kWheels, 5));
}

TEST_F(DeskTest, AnUnpluggedDeviceIsReportedAndComesBackWhileOthersGoOn) {
  desk.add(base(), line("base"), test::againAndAgain("unplug", 2));
  desk.add(lines(), line("compass"));
  desk.start(robotWithCompass());
  desk.read(kWheels, 3);
  desk.readWhile(0, DeviceState::kAbsent, kCompass, 5);
  expectCompassWentOn(
      desk.readUntil(0, [](const DeviceStatus& status) { return status.openings >= 2; }));
  expectAsGiven(desk.read(kWheels, 5));
}

TEST_F(DeskTest, GarbageIsRefusedAndWhatIsRightStaysRight) {
  desk.add(base(), line("base"), {"garbage"});
  DevicesSource& devices = desk.start(robot());
  const auto given = [&] { return source.given(kWheels); };
  for (const Message& message : desk.read(kWheels, 10)) {
    const auto all = given();
    EXPECT_NE(std::find(all.begin(), all.end(), message.words), all.end());
  }
  EXPECT_GT(devices.status()[0].refused, 0U);
}

TEST_F(DeskTest, HalfTelegramsAreRefused) {
  desk.add(base(), line("base"), {"half@0.5-100"});
  DevicesSource& devices = desk.start(robot());
  for (const Message& message : desk.read(kWheels, 10)) {
    const auto all = source.given(kWheels);
    EXPECT_NE(std::find(all.begin(), all.end(), message.words), all.end());
  }
  EXPECT_GT(devices.status()[0].refused, 0U);
}

TEST_F(DeskTest, AWrongSpeedOfTheLineIsReportedAndNothingIsTaken) {
  desk.add(base(115200), line("base"));
  desk.add(lines(), line("compass"));
  DevicesSource& devices = desk.start(robotWithCompass(", baud = 38400, late_after_s = 60"), false);
  const auto meanwhile = desk.readUntil(
      0, [](const DeviceStatus& status) { return status.state == DeviceState::kAbsent; });
  EXPECT_NE(devices.status()[0].reason.find("at 38400 baud"), std::string::npos)
      << devices.status()[0].reason;
  EXPECT_EQ(devices.status()[0].readings, 0U);
  expectCompassWentOn(meanwhile);
  desk.readWhile(0, DeviceState::kAbsent, kCompass, 5);
}

TEST_F(DeskTest, AClockThatIsSetIsNoticedAndStampsGoOn) {
  desk.add(base(), line("base"), {"jump:-100@1"});
  DevicesSource& devices = desk.start(robot());
  Timestamp last = 0;
  // A clock that is set back is believed once readings are late by the same for half a second,
  // which takes longer where a busy machine hands them over in bursts.
  constexpr Timestamp kBelieved = 3'000'000;
  for (const Message& message : desk.read(kWheels, 20)) {
    if (last != 0) {
      EXPECT_GT(message.stamp, last);
      EXPECT_LT(message.stamp - last, kBelieved);
    }
    last = message.stamp;
  }
  EXPECT_EQ(devices.status()[0].clockJumps, 1U);
}

TEST_F(DeskTest, AFloodIsCutDownAndDrownsNobody) {
  desk.add(base(1'000'000), line("base"), {"flood@1-2"});
  desk.add(lines(), line("compass"));
  DevicesSource& devices =
      desk.start(robotWithCompass(", baud = 1000000, most_per_s = 60, late_after_s = 60"));
  desk.read(kCompass, 30);
  EXPECT_GT(devices.status()[0].flooded, 0U);
  EXPECT_EQ(devices.status()[1].late, 0U);
  desk.readUntil(0, [](const DeviceStatus& status) { return status.rate < 60.0; });
}

// At this speed of the line the flood's readings would come for a minute.
TEST_F(DeskTest, AFloodedDeviceIsLateUntilItDropsWhatWaits) {
  desk.add(base(), line("base"), {"flood@1-2"});
  desk.add(lines(), line("compass"));
  DevicesSource& devices = desk.start(robotWithCompass(""));
  desk.read(kWheels, 3);
  expectCompassWentOn(desk.readUntil(0, [](const DeviceStatus& status) {
    return status.late > 10 && status.state == DeviceState::kRunning;
  }));
  expectAsGiven(desk.read(kWheels, 10));
  EXPECT_GT(devices.status()[0].late, 10U);
  EXPECT_EQ(devices.status()[0].clockJumps, 0U);
  EXPECT_EQ(devices.status()[0].openings, 1U);
}

TEST_F(DeskTest, ASilentDeviceGoesStaleAndRunsAgain) {
  desk.add(base(), line("base"), test::againAndAgain("silent", 2));
  desk.add(lines(), line("compass"));
  desk.start(robotWithCompass(", stale_after_s = 0.5, late_after_s = 60"));
  desk.read(kWheels, 3);
  desk.readWhile(0, DeviceState::kStale, kCompass, 5);
  expectCompassWentOn(desk.readUntil(
      0, [](const DeviceStatus& status) { return status.state == DeviceState::kRunning; }));
}

TEST_F(DeskTest, AFrozenDeviceIsToldAndNotUsed) {
  desk.add(base(), line("base"), test::againAndAgain("freeze", 2));
  desk.start(robot(", stale_after_s = 0.5, repeats = 3, late_after_s = 60"));
  desk.readUntil(0,
                 [](const DeviceStatus& status) { return status.state == DeviceState::kFrozen; });
  const auto meanwhile = desk.readUntil(
      0, [](const DeviceStatus& status) { return status.state == DeviceState::kRunning; });
  // Some may have waited that came before it was known.
  const auto sonar0 = meanwhile.find(toText(kSonar0));
  if (sonar0 == meanwhile.end()) return;
  constexpr std::size_t kRepeats = 4;
  for (std::size_t i = kRepeats; i < sonar0->second.size(); ++i)
    EXPECT_NE(sonar0->second[i].words, sonar0->second[i - kRepeats].words);
}

TEST_F(DeskTest, TheRobotIsDrivenThroughItsBase) {
  auto device = base();
  const auto& emulated = dynamic_cast<const EmulatedBase&>(*device);
  // Looked at by the thread that runs the emulator alone.
  class Told : public Endpoint {
   public:
    Told(std::unique_ptr<Endpoint> end, const EmulatedBase& base)
        : end_(std::move(end)), base_(base) {}
    std::string name() const override { return end_->name(); }
    int descriptor() const override { return end_->descriptor(); }
    void read(std::string& bytes) override { end_->read(bytes); }
    void write(std::string_view bytes) override {
      if (const auto velocity = base_.command(0)) {
        speed = velocity->translational;
        turn = velocity->rotational;
      }
      end_->write(bytes);
    }
    void unplug() override { end_->unplug(); }
    void plug() override { end_->plug(); }
    std::atomic<double> speed = 0.0;
    std::atomic<double> turn = 0.0;

   private:
    std::unique_ptr<Endpoint> end_;
    const EmulatedBase& base_;
  };
  auto end = std::make_unique<Told>(line("base"), emulated);
  const Told& told = *end;
  desk.add(std::move(device), std::move(end));
  DevicesSource& devices = desk.start(robot());
  desk.read(kWheels, 1);
  RobotCommands* const voice = devices.commands();
  ASSERT_NE(voice, nullptr);
  voice->setTranslationalVelocity(0.25);
  voice->setRotationalVelocity(-0.5);
  while (told.speed == 0.0 || told.turn == 0.0) desk.read(kWheels, 1);
  EXPECT_DOUBLE_EQ(told.speed, 0.25);
  EXPECT_NEAR(told.turn, -0.5, 1e-4);  // 1/100 degree
  // As a command vector, both at once; what is refused changes neither.
  voice->setMotion(std::vector{-0.125, 0.75});
  while (told.speed == 0.25 || told.turn < 0.0) desk.read(kWheels, 1);
  EXPECT_DOUBLE_EQ(told.speed, -0.125);
  EXPECT_NEAR(told.turn, 0.75, 1e-4);
  EXPECT_THROW(voice->setMotion(std::vector{0.1, 1e9}), std::invalid_argument);
  EXPECT_THROW(voice->setMotion(std::vector{0.1}), std::invalid_argument);
  EXPECT_THROW(voice->setMotion(std::vector{0.1, 0.2, 0.3}), std::invalid_argument);
  desk.read(kWheels, 5);
  EXPECT_DOUBLE_EQ(told.speed, -0.125);
  EXPECT_THROW(voice->setTranslationalVelocity(1e9), std::invalid_argument);
  EXPECT_THROW(voice->setManipulator("kicker", "out"), std::invalid_argument);
}

TEST_F(DeskTest, ARobotFileThatFitsNoDeviceIsRefusedWithTheReason) {
  const auto complaint = [&](const std::string& text) {
    const auto file = desk.dev() / "bad.toml";
    test::writeBytes(file, text);
    return test::messageOf<ConfigError>([&] { DevicesSource({file, desk.dev()}); });
  };
  EXPECT_NE(complaint("[[sensor]]\nplugin = 'odometry'\n").find("names no device"),
            std::string::npos);
  EXPECT_NE(complaint("[[sensor]]\nplugin = 'odometry'\n"
                      "device = { plugin = 'base', port = '/dev/a', boud = 1200 }\n")
                .find("boud is not known here"),
            std::string::npos);
  EXPECT_NE(complaint("[[sensor]]\nplugin = 'compass'\n"
                      "device = { plugin = 'base', port = '/dev/a' }\n")
                .find("is neither a sonar nor the only odometry"),
            std::string::npos);
  EXPECT_NE(complaint(robot() + "[[sensor]]\nplugin = 'sonar'\nfeature = 's'\n"
                                "device = { plugin = 'base', port = '/dev/base', baud = 9600 }\n")
                .find("expected all settings in the first one"),
            std::string::npos);
}

}  // namespace
}  // namespace ortung

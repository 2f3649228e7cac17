/// Devices that send whatever harms, through pseudo-terminals and the real drivers, beside sound
/// ones.
#include <gtest/gtest.h>

#include <functional>

#include "Desk.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/devices/BaseLines.hpp"
#include "ortung/emulators/EmulatedLines.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

const SensorId kWheels{"odometry", "odometry", "pose"};
const SensorId kCompass{"compass", "compass", "north"};

/// Answers what a base is asked, and sends what a test makes of the n-th reading of the wheels.
class Hostile : public EmulatedDevice {
 public:
  explicit Hostile(std::function<std::string(std::size_t n)> make) : make_(std::move(make)) {}
  void receive(std::string_view bytes, Timestamp now) override {
    if (bytes.find("?I") == bytes.npos) return;
    isAsked_ = true;
    send(base_lines::encode(base_lines::Identity{1, 0}), now);
  }
  void sense(const Message& reading, Timestamp now) override {
    if (reading.id == kWheels && isAsked_) send(make_(sent_++), now);
  }
  bool isMeasuring() const override { return isAsked_; }

 private:
  std::function<std::string(std::size_t)> make_;
  std::size_t sent_ = 0;
  bool isAsked_ = false;
};

std::string wheelsAt(std::uint32_t time, double x) {
  return base_lines::encode(base_lines::Odometry{.time = time, .pose = {x, 0.0, 0.0}});
}

struct DeskOfHostile : testing::Test {
  DeskOfHostile()
      : compass(kCompass, {}, {}),
        source(
            {{kWheels, [](std::size_t n) { return std::vector{static_cast<std::uint32_t>(n)}; }},
             {kCompass,
              [](std::size_t n) { return std::vector{static_cast<std::uint32_t>(n % 36000)}; }}}),
        desk(source) {}
  /// Reads until the sound compass has given @p count readings; checks the order and age of all.
  std::map<std::string, std::vector<Message>> read(std::function<std::string(std::size_t)> make,
                                                   std::size_t count) {
    const std::vector<const SensorData*> features{&compass};
    desk.add(std::make_unique<Hostile>(std::move(make)),
             std::make_unique<PseudoTerminal>(desk.dev() / "base"));
    desk.add(std::make_unique<EmulatedLines>(features, 115200),
             std::make_unique<PseudoTerminal>(desk.dev() / "compass"));
    devices = &desk.start(
        "[devices]\nwait_s = 5\n"  // on a busy machine, too, the compass comes as it was given
        "[[sensor]]\nplugin = 'odometry'\n"
        "device = { plugin = 'base', port = '/dev/base', stale_after_s = 60 }\n"
        "[[sensor]]\nplugin = 'compass'\n"
        "device = { plugin = 'lines', port = '/dev/compass', stale_after_s = 60, "
        "late_after_s = 60 }\n");
    const Timestamp begin = devices->clock()();
    std::map<std::string, std::vector<Message>> messages;
    Timestamp last = 0;
    for (Message message; messages[toText(kCompass)].size() < count;) {
      if (!devices->next(message)) break;
      EXPECT_GE(message.stamp, last);
      EXPECT_GE(message.stamp, begin - 11'000'000);
      EXPECT_LE(message.stamp, devices->clock()());
      last = message.stamp;
      messages[toText(message.id)].push_back(message);
    }
    expectAsGiven(messages[toText(kCompass)]);
    return messages;
  }
  void expectAsGiven(const std::vector<Message>& messages) {
    ASSERT_FALSE(messages.empty());
    const auto given = source.given(kCompass);
    auto at = std::find(given.begin(), given.end(), messages.front().words);
    for (const Message& message : messages) {
      ASSERT_NE(at, given.end());
      EXPECT_EQ(message.words, *at++);
    }
  }
  BearingData compass;
  test::Rehearsed source;
  test::Desk desk;
  DevicesSource* devices = nullptr;
};

using HostileDevicesTest = DeskOfHostile;

TEST_F(HostileDevicesTest, NoiseOfAllKindsIsLeftOutAndCounted) {
  Random random(3, 1);
  const auto noise = [&](std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i)
      bytes += static_cast<char>(static_cast<int>(random.uniform(0.0, 256.0)));
    return bytes;
  };
  const auto messages = read(
      [&](std::size_t n) -> std::string {
        const auto time = static_cast<std::uint32_t>(100 * n);
        std::string sound = wheelsAt(time, 0.5);
        switch (n % 7) {
          case 0:
            return sound;
          case 1:
            return noise(1000) + "\n";
          case 2:
            return sound.substr(0, sound.size() / 2) + "\n";
          case 3:
            return sound.substr(0, sound.find('*')) + "*0000\r\n";
          case 4:
            return std::string(1000, '7');  // a line without an end
          case 5:
            return "\n$O,-1,9223372036854775808,nan,1e300,0,0,0*0000\r\n";
          default:
            return sound + sound + sound;  // once is enough
        }
      },
      20);
  const auto wheels = messages.find(toText(kWheels));
  ASSERT_NE(wheels, messages.end());
  for (const Message& message : wheels->second) {
    OdometryData data(kWheels);
    data.setData(message.stamp, message.words);
    EXPECT_DOUBLE_EQ(data.reading().pose.x, 0.5);
  }
  desk.readUntil(0, [](const DeviceStatus& one) { return one.state == DeviceState::kRunning; });
  const DeviceStatus status = devices->status()[0];
  EXPECT_GT(status.refused, 4U);
  EXPECT_GT(status.repeated, 0U);
}

TEST_F(HostileDevicesTest, AClockThatJumpsBackAndForthHarmsNoStamps) {
  auto messages = read(
      [](std::size_t n) {
        const std::uint32_t hours = n % 2 == 0 ? 0U : 5U * 3'600'000U;
        return wheelsAt(static_cast<std::uint32_t>(100 * n) + hours, 0.5);
      },
      20);
  // It has two clocks: readings of the one that is ahead are used, those of the other come late.
  EXPECT_GT(messages[toText(kWheels)].size(), 3U);
  EXPECT_GT(devices->status()[0].late, 3U);
  EXPECT_GE(devices->status()[0].clockJumps, 1U);
}

TEST_F(HostileDevicesTest, AClockThatStandsStillGivesOneReading) {
  auto messages = read([](std::size_t) { return wheelsAt(100, 0.5); }, 20);
  EXPECT_LE(messages[toText(kWheels)].size(), 1U);
  EXPECT_GT(devices->status()[0].repeated, 3U);
}

}  // namespace
}  // namespace ortung

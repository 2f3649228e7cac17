#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/emulators/EmulatorFault.hpp"

namespace ortung {
namespace {

TEST(EmulatorFault, IsReadWithValueAndTimes) {
  const EmulatorFault jump = parseEmulatorFault("jump:-3.5@10-20");
  EXPECT_EQ(jump.kind, EmulatorFault::Kind::kJump);
  EXPECT_DOUBLE_EQ(jump.value, -3.5);
  EXPECT_FALSE(jump.isOn(9'999'999));
  EXPECT_TRUE(jump.isOn(10'000'000));
  EXPECT_FALSE(jump.isOn(20'000'000));
  EXPECT_TRUE(parseEmulatorFault("silent").isOn(0));
  EXPECT_TRUE(parseEmulatorFault("flood@2").isOn(1'000'000'000));
}

TEST(EmulatorFault, ThatMakesNoSenseIsRefusedWithTheReason) {
  const auto complaint = [](const char* text) {
    return test::messageOf<std::invalid_argument>([&] { parseEmulatorFault(text); });
  };
  EXPECT_NE(complaint("unplugged").find("with one of unplug, silent"), std::string::npos);
  EXPECT_NE(complaint("jump").find("expected jump:SECONDS"), std::string::npos);
  EXPECT_NE(complaint("half:3").find("half without a value"), std::string::npos);
  EXPECT_NE(complaint("half@5-2").find("FROM before TO"), std::string::npos);
  EXPECT_NE(complaint("jump:nan").find("numbers of seconds"), std::string::npos);
  EXPECT_NE(complaint("silent@").find("numbers of seconds"), std::string::npos);
}

TEST(EmulatorFault, DamagesTelegramsAsItSays) {
  Random random(1);
  const std::string telegram = "$S,1,0,1000*ABCD\r\n";
  EXPECT_EQ(damaged(telegram, EmulatorFault::Kind::kHalf, false, random), telegram);
  EXPECT_EQ(damaged(telegram, EmulatorFault::Kind::kHalf, true, random), telegram.substr(0, 9));
  EXPECT_TRUE(damaged(telegram, EmulatorFault::Kind::kGarbage, false, random).ends_with(telegram));
  const std::string noisy = damaged(telegram, EmulatorFault::Kind::kGarbage, true, random);
  EXPECT_FALSE(noisy.ends_with(telegram));
  EXPECT_NE(atWrongSpeed(telegram, random), telegram);
}

}  // namespace
}  // namespace ortung

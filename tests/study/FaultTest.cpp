#include <gtest/gtest.h>

#include "Files.hpp"
#include "MadeSource.hpp"
#include "ortung/study/Fault.hpp"

namespace ortung::test {
namespace {

std::string refusal(const std::string& text) {
  return messageOf<FaultError>([&] { parseFault(text); });
}

TEST(Fault, IsReadWithItsValuesAndItsTime) {
  const Fault fault = parseFault("odometry=jump:1,-2,90@20-50.5");
  EXPECT_EQ(fault.what, "odometry");
  EXPECT_EQ(fault.kind, Fault::Kind::kJump);
  ASSERT_EQ(fault.values.size(), 3u);
  EXPECT_EQ(fault.values[0], 1.0);
  EXPECT_EQ(fault.values[1], -2.0);
  EXPECT_NEAR(fault.values[2], 1.5707963267948966, 1e-15);
  EXPECT_EQ(fault.from, 20.0);
  EXPECT_EQ(fault.to, 50.5);
  EXPECT_EQ(fault.text, "odometry=jump:1,-2,90@20-50.5");
}

TEST(Fault, LastsForTheWholeRunWithoutATimeAndToItsEndWithoutAnEnd) {
  const Fault whole = parseFault("LMS200/LRF/scan=missing");
  EXPECT_EQ(whole.what, "LMS200/LRF/scan");
  EXPECT_EQ(whole.from, 0.0);
  EXPECT_EQ(whole.to, std::numeric_limits<double>::infinity());
  const Fault rest = parseFault("readings=frozen@7");
  EXPECT_EQ(rest.from, 7.0);
  EXPECT_EQ(rest.to, std::numeric_limits<double>::infinity());
}

TEST(Fault, HelpNamesEachWithWhatItTakes) {
  const std::string help = faultHelp();
  for (const char* text :
       {"missing", "frozen", "drop:SHARE", "late:SECONDS", "none", "zero", "scale:FACTOR",
        "turn:FACTOR", "reverse", "slip", "jump:X,Y,DEG", "crowd", "random:SHARE", "short:SHARE"})
    EXPECT_NE(help.find(std::string("    ") + text + " "), help.npos) << text << "\n" << help;
}

TEST(Fault, WrongTextIsRefusedWithWhatIsPermitted) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"", "WHAT=FAULT"},
      {"odometry", "WHAT=FAULT"},
      {"=none", "expected odometry, readings or"},
      {"scan=none", "model/type/feature"},
      {"a/b/c/d=none", "model/type/feature"},
      {"reference/groundTruth/pose=missing", "ground truth is never altered"},
      {"odometry=", "there is no fault ''"},
      {"odometry=None", "expected one of missing"},
      {"odometry=none:1", "takes no value"},
      {"odometry=none:", "takes no value"},
      {"odometry=scale", "expected scale:FACTOR"},
      {"odometry=scale:", "expected scale:FACTOR"},
      {"odometry=scale:nan", "expected scale:FACTOR"},
      {"odometry=scale:1e999", "expected scale:FACTOR"},
      {"odometry=scale:-1", "from 0 to 100"},
      {"odometry=scale:1,2", "expected scale:FACTOR"},
      {"odometry=jump:1,2", "expected jump:X,Y,DEG"},
      {"odometry=jump:1,2,1e9", "from -10000 to 10000"},
      {"readings=late:4000", "from 0 to 3600"},
      {"readings=drop:80", "from 0 to 1"},
      {"readings=slip", "expected odometry=slip"},
      {"odometry=crowd", "expected readings=crowd"},
      {"readings=missing@", "FROM-TO"},
      {"readings=missing@5-5", "0 <= FROM < TO"},
      {"readings=missing@9-5", "0 <= FROM < TO"},
      {"readings=missing@-5", "FROM-TO"},
      {"readings=missing@1-2-3", "FROM-TO"},
      {"readings=missing@0-inf", "FROM-TO"},
      {"readings=missing@5-6@7", "FROM-TO"},
  };
  for (const auto& [text, expected] : wrong) {
    const std::string message = refusal(text);
    EXPECT_TRUE(message.starts_with("fault '" + text + "': ")) << message;
    EXPECT_NE(message.find(expected), message.npos) << message;
  }
}

TEST(Fault, OfWhatTheRobotLacksIsRefusedWithWhatItHas) {
  const MadeRobot robot;
  const auto refused = [&](const std::string& text) {
    return messageOf<FaultError>([&] { robot.disturb({}, {text}); });
  };
  EXPECT_EQ(refused("a/b/c=missing"),
            "fault 'a/b/c=missing': the robot has no feature 'a/b/c', its features are "
            "LMS200/LRF/scan, base/odometry/pose, front/sonar/distance");
  EXPECT_NE(refused("front/sonar/distance=crowd").find("no scan 'front"), std::string::npos);
  EXPECT_NE(refused("front/sonar/distance=slip").find("no odometry 'front"), std::string::npos);
  SensorContainer bare;
  EXPECT_NE(messageOf<FaultError>([&] {
              disturbed(std::make_unique<MadeSource>(std::vector<Message>{}),
                        {parseFault("odometry=none")}, bare, 1);
            }).find("its features are none"),
            std::string::npos);
}

}  // namespace
}  // namespace ortung::test

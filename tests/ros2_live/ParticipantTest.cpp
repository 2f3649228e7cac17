// A node of ROS 2 over DDS: names, and bytes that arrive as they were sent.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <set>
#include <stdexcept>

#include "Participant.hpp"

namespace ortung::ros2 {
namespace {

TEST(RosNames, AreThoseOfRmw) {
  EXPECT_EQ(ddsTopic("/scan"), "rt/scan");
  EXPECT_EQ(ddsTopic("scan"), "rt/scan");
  EXPECT_EQ(ddsTopic("/robot/tf"), "rt/robot/tf");
  EXPECT_EQ(ddsType("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
  EXPECT_EQ(ddsType("nav2_msgs/msg/ParticleCloud"), "nav2_msgs::msg::dds_::ParticleCloud_");
}

class RosEnvironment : public testing::Test {
 protected:
  void TearDown() override {
    for (const char* name :
         {"ROS_DOMAIN_ID", "ROS_LOCALHOST_ONLY", "ROS_AUTOMATIC_DISCOVERY_RANGE"})
      unsetenv(name);
  }
  static Participant::Options read() {
    Participant::Options options;
    options.readEnvironment();
    return options;
  }
};

TEST_F(RosEnvironment, SaysDomainAndRange) {
  EXPECT_EQ(read().domain, 0u);
  EXPECT_FALSE(read().isLocal);
  setenv("ROS_DOMAIN_ID", "42", 1);
  setenv("ROS_LOCALHOST_ONLY", "1", 1);
  EXPECT_EQ(read().domain, 42u);
  EXPECT_TRUE(read().isLocal);
  setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET", 1);
  EXPECT_FALSE(read().isLocal) << "the newer one counts";
  setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST", 1);
  EXPECT_TRUE(read().isLocal);
}

TEST_F(RosEnvironment, RefusesWhatIsNone) {
  for (const char* domain : {"233", "-1", "7x", "x"}) {
    setenv("ROS_DOMAIN_ID", domain, 1);
    EXPECT_THROW(read(), std::runtime_error) << domain;
  }
  setenv("ROS_DOMAIN_ID", "1", 1);
  setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "PLANET", 1);
  EXPECT_THROW(read(), std::runtime_error);
}

/// What arrives at a reader.
class Inbox {
 public:
  void take(std::string_view bytes) {
    const std::lock_guard lock(mutex_);
    found_.insert(std::string(bytes));
    arrived_.notify_all();
  }
  bool has(const std::string& bytes) {
    std::unique_lock lock(mutex_);
    return arrived_.wait_for(lock, std::chrono::seconds(1), [&] { return found_.contains(bytes); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::set<std::string> found_;
};

class ParticipantTest : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "Fast DDS 2.9 frees memory as another type than it was, and knows no sanitizer";
#endif
  }
};

TEST_F(ParticipantTest, SendsTheBytesThatItIsGiven) {
  Participant::Options options;
  options.isLocal = true;
  options.domain = 1 + static_cast<std::uint32_t>(getpid()) % 40;  // one of the test's own
  options.names.node = "one";
  Inbox inbox;
  Inbox late;
  Participant one(options);
  options.names.node = "two";
  Participant two(options);
  const auto latched = one.publish("/map", "nav_msgs/msg/OccupancyGrid", Qos::kLatched);
  const auto send = one.publish("/scan", "sensor_msgs/msg/LaserScan", Qos::kSensor);
  two.subscribe("/scan", "sensor_msgs/msg/LaserScan", Qos::kSensor,
                [&](std::string_view bytes) { inbox.take(bytes); });
  const std::string small("\0\1\0\0abcd", 8);
  const std::string large = std::string("\0\1\0\0", 4) + std::string(3'000'000, 'x');
  latched(large);
  bool isThere = false;
  for (int i = 0; i < 30 && !isThere; ++i) {  // until they know of each other
    send(small);
    isThere = inbox.has(small);
  }
  EXPECT_TRUE(isThere);
  two.subscribe("/map", "nav_msgs/msg/OccupancyGrid", Qos::kLatched,
                [&](std::string_view bytes) { late.take(bytes); });
  bool came = false;
  for (int i = 0; i < 30 && !came; ++i) came = late.has(large);
  EXPECT_TRUE(came) << "what is latched is also for those who come later";
  EXPECT_EQ(one.dropped(), 0u);
}

// Nobody who publishes waits for himself: what is published under a lock may be heard by a taker
// that wants the same one.
TEST_F(ParticipantTest, PublishesWhileItsOwnTakersWait) {
  Participant::Options options;
  options.isLocal = true;
  options.domain = 1 + static_cast<std::uint32_t>(getpid()) % 40;
  Participant node(options);
  std::mutex mutex;
  const std::string bytes("\0\1\0\0abcd", 8);
  const auto ping = node.publish("/ping", "std_msgs/msg/String", Qos::kDefault);
  const auto pong = node.publish("/pong", "std_msgs/msg/String", Qos::kDefault);
  Inbox inbox;
  node.subscribe("/ping", "std_msgs/msg/String", Qos::kDefault, [&](std::string_view) {
    const std::lock_guard lock(mutex);
    pong(bytes);
  });
  node.subscribe("/pong", "std_msgs/msg/String", Qos::kDefault, [&](std::string_view taken) {
    const std::lock_guard lock(mutex);
    inbox.take(taken);
  });
  bool isThere = false;
  for (int i = 0; i < 30 && !isThere; ++i) {
    for (int k = 0; k < 200; ++k) {
      ping(bytes);
      const std::lock_guard lock(mutex);
      pong(bytes);
    }
    isThere = inbox.has(bytes);
  }
  EXPECT_TRUE(isThere);
}

TEST_F(ParticipantTest, CountsWhatATakerThrowsAt) {
  Participant::Options options;
  options.isLocal = true;
  options.domain = 1 + static_cast<std::uint32_t>(getpid()) % 40;
  Participant node(options);
  const auto send = node.publish("/thrown", "std_msgs/msg/String", Qos::kDefault);
  node.subscribe("/thrown", "std_msgs/msg/String", Qos::kDefault,
                 [](std::string_view) { throw std::runtime_error("no"); });
  Inbox inbox;
  node.subscribe("/kept", "std_msgs/msg/String", Qos::kDefault,
                 [&](std::string_view bytes) { inbox.take(bytes); });
  const auto keep = node.publish("/kept", "std_msgs/msg/String", Qos::kDefault);
  const std::string bytes("\0\1\0\0abcd", 8);
  for (int i = 0; i < 30 && node.refused() == 0; ++i) {
    send(bytes);
    keep(bytes);
    inbox.has("");  // a second, or less
  }
  EXPECT_GT(node.refused(), 0u);
}

}  // namespace
}  // namespace ortung::ros2

// A client of Foxglove's protocol and a message board, both played by the test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "ortung/core/BinaryReading.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/foxglove/FoxgloveSession.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung {
namespace {

using nlohmann::json;
using namespace std::string_literals;

constexpr const char* kSimulation =
    "world=f2000 kind=simulation x_min_m=-2 y_min_m=-1 x_max_m=2 y_max_m=1";

class FoxgloveSessionTest : public ::testing::Test {
 protected:
  /// What the session has said to the board.
  std::string saidToBoard() { return std::exchange(session_.toBoard, {}); }
  std::vector<FoxgloveSession::Frame> saidToClient() {
    return std::exchange(session_.toClient, {});
  }
  /// Texts of a kind among what it has said to the client.
  std::vector<json> texts(const std::string& op) {
    std::vector<json> found;
    for (const auto& frame : saidToClient())
      if (!frame.isBinary && json::parse(frame.bytes)["op"] == op)
        found.push_back(json::parse(frame.bytes));
    return found;
  }
  void client(const json& message) { session_.fromClient(message.dump(), false); }

  /// What the board says of a robot that has odometry and truth. Texts for people may say anything.
  static std::vector<std::string> described() {
    return {"odometry/odometry/pose how far it went", "format odometry/odometry/pose odometry",
            "reference/groundTruth/pose [distance mm] of each of 9 beams from 0 deg",
            "format reference/groundTruth/pose pose", "some/thing/else"};
  }
  /// Goes as far as a world with one robot.
  /// @param truth what the board answers to who wants the world's truth
  void meet(const std::string& world = kSimulation,
            const std::vector<std::string>& robot = described(),
            const std::string& truth = "ERR unknown-robot") {
    EXPECT_EQ(saidToBoard(), "HELLO ortung/1 name=foxglove role=viewer\nDESCRIBE world\n");
    session_.fromBoard("OK HELLO client=1 role=viewer kind=simulation now=1000000 state=running\n");
    session_.fromBoard("OK DESCRIBE lines=1\n" + world + "\n");
    EXPECT_EQ(saidToBoard(),
              "DESCRIBE field\nSUBSCRIBE robot=0 period_s=1 form=binary world/truth/robots\n"
              "LIST robots\n");
    session_.fromBoard(
        "OK DESCRIBE lines=1\nwall x0_m=-0.98 y0_m=1.02 x1_m=0.98 y1_m=1.02 z0_m=0 z1_m=1\n" +
        truth + "\nOK LIST lines=1\nrobot=3 name=my-robot client=0\n");
    EXPECT_EQ(saidToBoard(), "DESCRIBE robot robot=3\n");
    session_.fromBoard("OK DESCRIBE lines=" + std::to_string(robot.size()) + "\n");
    for (const std::string& line : robot) session_.fromBoard(line + "\n");
  }
  /// Channels by topic, as the session has advertised them.
  std::map<std::string, json> channels() {
    std::map<std::string, json> found;
    for (const json& message : texts("advertise"))
      for (const json& channel : message["channels"]) found[channel["topic"]] = channel;
    return found;
  }
  static std::string binary(const std::vector<Message>& readings, const std::string& now) {
    std::string bytes;
    for (const Message& reading : readings) writeBinary(reading, bytes);
    return "* UPDATE robot=3 now=" + now + " bytes=" + std::to_string(bytes.size()) +
           " readings=" + std::to_string(readings.size()) + "\n" + bytes;
  }

  FoxgloveSession session_;
};

TEST_F(FoxgloveSessionTest, AdvertisesARobotsTopicsUnderItsNameAndAsksForWhatIsSubscribed) {
  meet();
  auto found = channels();
  ASSERT_TRUE(found.contains("/my_robot/odom"));
  EXPECT_EQ(found["/my_robot/odom"]["schemaName"], "nav_msgs/msg/Odometry");
  EXPECT_EQ(found["/my_robot/odom"]["encoding"], "cdr");
  EXPECT_TRUE(found.contains("/my_robot/ortung/some/thing/else"));
  EXPECT_EQ(saidToBoard(), "");
  client({{"op", "subscribe"},
          {"subscriptions", {{{"id", 7}, {"channelId", found["/my_robot/odom"]["id"]}}}}});
  EXPECT_EQ(saidToBoard(), "SUBSCRIBE robot=3 form=binary odometry/odometry/pose\n");
  client(
      {{"op", "subscribe"}, {"subscriptions", {{{"id", 8}, {"channelId", found["/tf"]["id"]}}}}});
  EXPECT_EQ(saidToBoard(),
            "SUBSCRIBE robot=3 form=binary */groundTruth/* mcl/LOCALIZATION/pose "
            "odometry/odometry/pose\n");
  client({{"op", "unsubscribe"}, {"subscriptionIds", {7, 8}}});
  EXPECT_EQ(saidToBoard(), "UNSUBSCRIBE robot=3\n");
}

/// The type of a topic's messages; "" without it.
std::string typeOf(const std::map<std::string, json>& channels, const std::string& topic) {
  const auto found = channels.find(topic);
  return found == channels.end() ? "" : found->second.at("schemaName").get<std::string>();
}

TEST_F(FoxgloveSessionTest, KnowsFeaturesByTheirFormatsAndNotByTheirTexts) {
  meet(kSimulation,
       {"format laser/LRF/scan scan beams=3 first_deg=-90 step_deg=90 max_m=8",  // may come before
        "laser/LRF/scan", "sonar/US/front [identity, distance mm, bearing", "camera/camera/image",
        "gps/GPS/fix", "format sonar/US/front cone opening_deg=30 max_m=3",
        "format camera/camera/image image width=64 height=48", "format gps/GPS/fix fix",
        "mount laser/LRF/scan x_m=0.5 y_m=0 theta_rad=0", "odometry/odometry/pose [x mm + 2^31"});
  const auto found = channels();
  EXPECT_EQ(typeOf(found, "/my_robot/scan"), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(typeOf(found, "/my_robot/range/sonar/front"), "sensor_msgs/msg/Range");
  EXPECT_EQ(typeOf(found, "/my_robot/image"), "sensor_msgs/msg/Image");
  EXPECT_EQ(typeOf(found, "/my_robot/pose_fix"), "geometry_msgs/msg/PoseWithCovarianceStamped");
  EXPECT_FALSE(found.contains("/my_robot/odom"));  // nothing has said so
  EXPECT_TRUE(found.contains("/my_robot/ortung/odometry/odometry/pose"));

  client({{"op", "subscribe"},
          {"subscriptions", {{{"id", 7}, {"channelId", found.at("/my_robot/scan")["id"]}}}}});
  saidToClient();
  session_.fromBoard(
      "OK SUBSCRIBE robot=3\n" +
      binary({{2'000'000, {"laser", "LRF", "scan"}, {1000, 2000, 8000}}}, "2100000"));
  const auto frames = saidToClient();
  ASSERT_FALSE(frames.empty());
  std::string why;
  const auto scan = ros2::fromCdr<ros2::LaserScan>(frames[0].bytes.substr(13), why);
  ASSERT_TRUE(scan) << why;
  EXPECT_FLOAT_EQ(scan->angleMin, -1.57079633F);
  EXPECT_FLOAT_EQ(scan->angleIncrement, 1.57079633F);
  EXPECT_EQ(scan->ranges.size(), 3u);
}

TEST_F(FoxgloveSessionTest, WhatHasNoFormatOrABadOneIsWords) {
  const std::vector<std::string> bad{"scan",
                                     "scan beams=0 first_deg=0 step_deg=1 max_m=8",
                                     "scan beams=1e300 first_deg=0 step_deg=1 max_m=8",
                                     "scan beams=2.5 first_deg=0 step_deg=1 max_m=8",
                                     "scan beams=2 first_deg=nan step_deg=1 max_m=8",
                                     "cone opening_deg=x max_m=1",
                                     "Scan beams=2",
                                     "scan beams=2 beams=2",
                                     std::string(2000, 'a'),
                                     " ",
                                     "mine row=,",
                                     "mine",
                                     "talk"};
  std::vector<std::string> lines{"format", "format a/b", "format nobody/has/it pose", "mount"};
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const std::string name = "a/b/c" + std::to_string(i);
    lines.push_back(name +
                    " [distance mm]; 0: not valid; from 8000 on: nothing seen, within 5 deg");
    lines.push_back("format " + name + " " + bad[i]);
  }
  meet(kSimulation, lines);
  const auto found = channels();
  for (std::size_t i = 0; i < bad.size(); ++i)
    EXPECT_TRUE(found.contains("/my_robot/ortung/a/b/c" + std::to_string(i))) << bad[i];
}

TEST_F(FoxgloveSessionTest, GivesReadingsAsMessagesHoweverTheBoardsBytesAreCut) {
  meet();
  auto found = channels();
  client({{"op", "subscribe"},
          {"subscriptions",
           {{{"id", 7}, {"channelId", found["/my_robot/odom"]["id"]}},
            {{"id", 9}, {"channelId", found["/my_robot/ortung/some/thing/else"]["id"]}}}}});
  saidToClient();
  OdometryData::Reading state;
  state.pose.x = 1.5;
  const std::string update =
      "OK SUBSCRIBE robot=3\n" +
      binary({{2'000'000, {"odometry", "odometry", "pose"}, OdometryData::encode(state)},
              {2'000'000, {"some", "thing", "else"}, {1, 2}}},
             "2100000");
  for (const char byte : update) session_.fromBoard({&byte, 1});
  const auto frames = saidToClient();
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].bytes.substr(0, 13),
            "\x01\x07\x00\x00\x00\x00\x94\x35\x77\x00\x00\x00\x00"s);  // 2 * 10^9 ns
  std::string why;
  const auto odom = ros2::fromCdr<ros2::Odometry>(frames[0].bytes.substr(13), why);
  ASSERT_TRUE(odom) << why;
  EXPECT_EQ(odom->pose.position.x, 1.5);
  EXPECT_EQ(odom->header.frame, "my_robot/odom");
  const auto words = ros2::fromCdr<ros2::Words>(frames[1].bytes.substr(13), why);
  ASSERT_TRUE(words) << why;
  EXPECT_EQ(words->data, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(frames[2].bytes, "\x02\x00\x75\x2B\x7D\x00\x00\x00\x00"s);  // 2.1 * 10^9 ns
}

// Of robots that have no feature for it, the world says where they are.
TEST_F(FoxgloveSessionTest, GivesTheWorldsTruthOfARobotThatHasNone) {
  meet(kSimulation, {"odometry/odometry/pose how far it went"}, "OK SUBSCRIBE robot=0");
  const auto found = channels();
  ASSERT_TRUE(found.contains("/my_robot/ground_truth"));
  const auto update = [](const std::vector<std::uint32_t>& words) {
    std::string bytes;
    writeBinary({2'000'000, {"world", "truth", "robots"}, words}, bytes);
    return "* UPDATE robot=0 now=2100000 bytes=" + std::to_string(bytes.size()) + " readings=1\n" +
           bytes;
  };
  constexpr std::uint32_t kZero = 1U << 31;
  // A robot that it does not know, and its own at (1.5, -0.25) m, 270 degrees; a torn third one.
  const std::vector<std::uint32_t> words{2,           kZero, kZero, 0, 0,     3,    kZero + 1500,
                                         kZero - 250, 27000, 0,     3, kZero, kZero};
  session_.fromBoard(update(words));
  for (const auto& frame : saidToClient())
    EXPECT_NE(frame.bytes[0], '\x01') << "nobody has subscribed";
  client(
      {{"op", "subscribe"},
       {"subscriptions", {{{"id", 7}, {"channelId", found.at("/my_robot/ground_truth")["id"]}}}}});
  EXPECT_EQ(saidToBoard(),
            "SUBSCRIBE robot=3 form=binary */groundTruth/*\n"
            "SUBSCRIBE robot=0 form=binary world/truth/robots\n");
  session_.fromBoard("OK SUBSCRIBE robot=3\nOK SUBSCRIBE robot=0\n" + update(words));
  std::vector<std::string> messages;
  for (const auto& frame : saidToClient())
    if (frame.isBinary && frame.bytes[0] == '\x01') messages.push_back(frame.bytes);
  ASSERT_EQ(messages.size(), 1u);
  std::string why;
  const auto truth = ros2::fromCdr<ros2::PoseStamped>(messages[0].substr(13), why);
  ASSERT_TRUE(truth) << why;
  EXPECT_EQ(truth->header.frame, "map");
  EXPECT_NEAR(truth->pose.position.x, 1.5, 1e-9);
  EXPECT_NEAR(truth->pose.position.y, -0.25, 1e-9);
  EXPECT_NEAR(truth->pose.orientation.z, -std::sqrt(0.5), 1e-9);  // a turn of -90 degrees
  EXPECT_NEAR(truth->pose.orientation.w, std::sqrt(0.5), 1e-9);
  client({{"op", "unsubscribe"}, {"subscriptionIds", {7}}});
  EXPECT_EQ(saidToBoard(),
            "UNSUBSCRIBE robot=3\nSUBSCRIBE robot=0 period_s=1 form=binary world/truth/robots\n");
}

TEST_F(FoxgloveSessionTest, TheFieldsWallsAreTheMapWhoeverComesWhen) {
  meet();
  auto found = channels();
  client(
      {{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", found["/map"]["id"]}}}}});
  const auto frames = saidToClient();
  ASSERT_EQ(frames.size(), 1u);
  std::string why;
  const auto map = ros2::fromCdr<ros2::OccupancyGrid>(frames[0].bytes.substr(13), why);
  ASSERT_TRUE(map) << why;
  EXPECT_EQ(map->header.frame, "map");
  EXPECT_EQ(map->width, 100u);  // 4 m, half a metre around them, in cells of 5 cm
  EXPECT_EQ(map->height, 60u);
  // The wall of 1.96 m begins 1.52 m from the left edge, 2.52 m from the lower one.
  EXPECT_EQ(std::count(map->data.begin(), map->data.end(), 100), 40);
  EXPECT_EQ(map->data[50 * 100 + 30], 100);
  EXPECT_EQ(map->data[50 * 100 + 29], 0);
}

TEST_F(FoxgloveSessionTest, ARobotThatLeavesTakesItsChannelsWithIt) {
  meet();
  const std::size_t count = channels().size();
  session_.fromBoard("* REMOVE robot=3\n");
  const auto gone = texts("unadvertise");
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_GE(gone[0]["channelIds"].size(), count - 1);  // the map stays
}

TEST_F(FoxgloveSessionTest, AMessageFullOfFaultsIsAnsweredInFewWords) {
  meet();
  saidToClient();
  std::string subscriptions = "{}";
  for (int i = 0; i < 40'000; ++i) subscriptions += ",{}";
  for (const char* before : {"{\"op\":\"subscribe\",\"subscriptions\":[",
                             "{\"op\":\"unsubscribe\",\"subscriptionIds\":["}) {
    const bool isAsking = std::string(before).find("unsub") == std::string::npos;
    std::string list = subscriptions;
    if (!isAsking) std::replace_if(list.begin(), list.end(), [](char c) { return c != ','; }, '7');
    session_.fromClient(before + list + "]}", false);
    const auto told = texts("status");
    ASSERT_EQ(told.size(), 9u);
    EXPECT_EQ(told.back()["message"], "the same message has 39993 more such faults");
  }
  session_.fromClient("nonsense", false);
  EXPECT_EQ(texts("status").size(), 1u) << "the next message is a new one";
}

TEST_F(FoxgloveSessionTest, PlaysPausesAndSeeksInARecordAlone) {
  const std::string play =
      "\x03\x00\x00\x00\x00\x40\x01\x00\x94\x35\x77\x00\x00\x00\x00\x02\x00\x00\x00id"s;
  meet();
  saidToClient();
  session_.fromClient(play, true);
  EXPECT_EQ(texts("status").size(), 1u);
  EXPECT_EQ(saidToBoard(), "");
}

TEST_F(FoxgloveSessionTest, ARecordHasATimeLine) {
  meet("world=run kind=record start_us=1000000 end_us=9000000");
  json info;
  for (const auto& frame : saidToClient())
    if (!frame.isBinary && json::parse(frame.bytes)["op"] == "serverInfo")
      info = json::parse(frame.bytes);
  EXPECT_EQ(info["dataStartTime"], (json{{"sec", 1}, {"nsec", 0}}));
  EXPECT_EQ(info["dataEndTime"], (json{{"sec", 9}, {"nsec", 0}}));
  // Play at twice the speed from 2 s of its clock on, which is 1 s from its beginning.
  session_.fromClient(
      "\x03\x00\x00\x00\x00\x40\x01\x00\x94\x35\x77\x00\x00\x00\x00\x02\x00\x00\x00id"s, true);
  EXPECT_EQ(saidToBoard(), "SPEED 2.000000\nSEEK time_s=1.000000\nRESUME\nSTATUS\n");
  session_.fromBoard(
      "OK SPEED\nOK SEEK\nOK RESUME now=2000000\nOK STATUS state=running now=2000000 speed=2\n");
  const auto frames = saidToClient();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].bytes,
            "\x05\x00\x00\x94\x35\x77\x00\x00\x00\x00\x00\x00\x00\x40\x01\x02\x00\x00\x00id"s);
  session_.fromClient(
      "\x03\x01\x00\x00\x80\x3F\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"s, true);
  EXPECT_EQ(saidToBoard(), "SPEED 1.000000\nPAUSE\nSTATUS\n");
  session_.fromBoard("ERR role only operators may\n");
  EXPECT_EQ(texts("status").size(), 1u);
}

TEST_F(FoxgloveSessionTest, RefusesToPlayAtSpeedsThatAreNone) {
  meet("world=run kind=record start_us=0 end_us=9000000");
  for (const std::string& speed :
       {"\x00\x00\xC0\x7F"s, "\x00\x00\x80\x7F"s, "\x00\x00\x80\xBF"s, "\x00\x00\x00\x00"s}) {
    saidToClient();
    session_.fromClient(
        "\x03\x00"s + speed + "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"s, true);
    EXPECT_EQ(texts("status").size(), 1u);
  }
  EXPECT_EQ(saidToBoard(), "");
}

/// What a client sends on a channel of its own.
std::string published(std::uint32_t channel, std::string_view message) {
  std::string bytes(1, '\x01');
  bytes.append(reinterpret_cast<const char*>(&channel), sizeof channel);
  return bytes.append(message);
}

json channelOf(int id, const std::string& topic, const std::string& encoding,
               const std::string& type) {
  return {
      {"op", "advertise"},
      {"channels", {{{"id", id}, {"topic", topic}, {"encoding", encoding}, {"schemaName", type}}}}};
}

TEST_F(FoxgloveSessionTest, APoseThatAClientPublishesIsTheFiltersStart) {
  meet();
  saidToBoard();
  client(channelOf(1, "/initialpose", "cdr", "geometry_msgs/msg/PoseWithCovarianceStamped"));
  ros2::PoseWithCovarianceStamped pose;
  pose.header.frame = "map";
  pose.pose.position = {1.5, -2.0, 0.0};
  pose.pose.orientation = {0.0, 0.0, std::sin(0.25 * M_PI), std::cos(0.25 * M_PI)};  // 90 degrees
  pose.covariance[0] = 0.25;
  pose.covariance[7] = 0.25;
  pose.covariance[35] = std::pow(M_PI / 12.0, 2);  // 15 degrees
  session_.fromClient(published(1, ros2::toCdr(pose)), true);
  EXPECT_EQ(saidToBoard(),
            "LOCALIZE x_m=1.5 y_m=-2 theta_deg=90 sigma_m=0.5 sigma_deg=15 robot=3\n");
  // Foxglove's own JSON, behind the robot's name. A covariance of zeros says nothing.
  client(channelOf(2, "/my_robot/initialpose", "json", "geometry_msgs/PoseWithCovarianceStamped"));
  session_.fromClient(
      published(2, json{{"header", {{"frame_id", "map"}}},
                        {"pose",
                         {{"pose",
                           {{"position", {{"x", 3}, {"y", 4}, {"z", 0}}},
                            {"orientation", {{"x", 0}, {"y", 0}, {"z", 1}, {"w", 0}}}}},
                          {"covariance", std::vector<double>(36, 0.0)}}}}
                       .dump()),
      true);
  EXPECT_EQ(saidToBoard(), "LOCALIZE x_m=3 y_m=4 theta_deg=180 robot=3\n");
  EXPECT_TRUE(texts("status").empty());
  pose.header.frame = "odom";
  session_.fromClient(published(1, ros2::toCdr(pose)), true);
  pose.header.frame = "map";
  pose.pose.position.x = NAN;
  session_.fromClient(published(1, ros2::toCdr(pose)), true);
  pose.pose.position.x = 0.0;
  pose.pose.orientation = {0.0, 0.0, 0.0, 0.0};
  session_.fromClient(published(1, ros2::toCdr(pose)), true);
  session_.fromClient(published(1, "short"), true);
  session_.fromClient(published(2, "[1]"), true);
  session_.fromClient(published(2, R"({"pose":{"pose":{"position":{"x":"far"}}}})"), true);
  EXPECT_EQ(saidToBoard(), "");
  EXPECT_EQ(texts("status").size(), 6u);
}

TEST_F(FoxgloveSessionTest, AVelocityThatAClientPublishesDrivesTheRobotUntilItsChannelGoes) {
  meet();
  saidToBoard();
  client(channelOf(5, "/cmd_vel", "json", "geometry_msgs/msg/Twist"));
  const auto drive = [&](const json& twist) {
    session_.fromClient(published(5, twist.dump()), true);
    return saidToBoard();
  };
  EXPECT_EQ(drive({{"linear", {{"x", 0.3}}}, {"angular", {{"z", -0.5}}}}),
            "VELOCITY v_m_s=0.3 w_rad_s=-0.5 robot=3\n");
  // A refusal is told once, though velocities come many times a second.
  EXPECT_NE(drive({{"linear", {{"x", 0.4}}}}), "");
  saidToClient();
  session_.fromBoard("ERR role only operators may\nERR role only operators may\n");
  const auto told = texts("status");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0]["message"].get<std::string>().find("?token=T"), std::string::npos);
  EXPECT_EQ(drive({{"linear", {{"y", 0.3}}}}), "");  // sideways
  EXPECT_EQ(drive({{"linear", {{"x", 1e9}}}}), "");
  EXPECT_EQ(texts("status").size(), 2u);
  // With a time, in CDR.
  client(channelOf(6, "my_robot/cmd_vel", "cdr", "geometry_msgs/msg/TwistStamped"));
  ros2::TwistStamped stamped;
  stamped.twist.linear.x = 1.0;
  session_.fromClient(published(6, ros2::toCdr(stamped)), true);
  EXPECT_EQ(saidToBoard(), "VELOCITY v_m_s=1 w_rad_s=0 robot=3\n");
  client({{"op", "unadvertise"}, {"channelIds", {5}}});
  EXPECT_EQ(saidToBoard(), "VELOCITY v_m_s=0 w_rad_s=0 robot=3\n");
  session_.fromClient(published(5, "{}"), true);
  EXPECT_EQ(saidToBoard(), "");
  EXPECT_EQ(texts("status").size(), 1u);
}

TEST_F(FoxgloveSessionTest, ChannelsOfClientsThatNobodyListensToAreRefused) {
  meet();
  saidToBoard();
  saidToClient();
  const std::string pose = "geometry_msgs/msg/PoseWithCovarianceStamped";
  client(channelOf(1, "/goal_pose", "json", "geometry_msgs/msg/PoseStamped"));
  client(channelOf(2, "/initialpose", "protobuf", pose));
  client(channelOf(3, "/initialpose", "json", "geometry_msgs/msg/Pose"));
  client({{"op", "advertise"}, {"channels", {{{"topic", "/cmd_vel"}}, 7, nullptr}}});
  EXPECT_EQ(texts("status").size(), 6u);
  client(channelOf(4, "/nobody/initialpose", "json", pose));
  session_.fromClient(published(4, R"({"pose":{"pose":{"orientation":{"w":1}}}})"), true);
  const auto told = texts("status");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0]["message"].get<std::string>().find("no robot 'nobody'"), std::string::npos);
  EXPECT_EQ(saidToBoard(), "");
}

TEST_F(FoxgloveSessionTest, EndsWhenTheBoardRefusesIt) {
  session_.fromBoard("ERR token wrong\n");
  EXPECT_TRUE(session_.isOver);
  const auto statuses = texts("status");
  ASSERT_EQ(statuses.size(), 1u);
  EXPECT_EQ(statuses[0]["message"], "the board refuses: ERR token wrong");
}

}  // namespace
}  // namespace ortung

// What a team tells becomes readings: where mates see this robot, and where others are.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ortung/core/PluginFactory.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/TalkData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

/// A place without correlations.
Place placeOf(const std::string& name, const Pose2& pose, double sx, double sy, double heading) {
  return {
      Place::Kind::kRobot, name, {pose, {sx * sx, 0, 0, 0, sy * sy, 0, 0, 0, heading * heading}}};
}

/// A robot named anna that hears its team.
struct Listener {
  PluginFactory factory{PluginFactory::standardFolders()};
  SensorContainer container;
  Timestamp now = 0;

  explicit Listener(const std::string& keys = "") {
    fillContainer(
        container,
        readRobot(parseToml(
            "[robot]\nname = 'anna'\nradius_m = 0.2\n[[sensor]]\nplugin = 'teammate'\n" + keys,
            "robot")),
        factory);
  }
  void hear(double seconds, const std::vector<TalkData::Message>& messages) {
    now = fromSeconds(seconds);
    const std::vector<Message> heard = {
        {now, {"radio", "teammate", "talk"}, TalkData::encode({"anna", messages})}};
    container.set(heard);
  }
  const PoseFixData& position() {
    return dynamic_cast<const PoseFixData&>(*container.find({.feature = "position"}));
  }
  const PlacesData& places(const char* feature) {
    return dynamic_cast<const PlacesData&>(*container.find({.feature = feature}));
  }
};

constexpr double kAdded = 0.05;  // the plugin's default sigma_m

TEST(Teammate, WhereMatesSeeIt) {
  Listener anna;
  anna.hear(1.0, {{0.01, "bert", toText(placeOf("anna", {1.0, 2.0, 0.5}, 0.3, 0.1, 0.1))},
                  {0.01, "bert", "hello"}});
  ASSERT_EQ(anna.position().reading().size(), 1u);
  const PoseFixData::Fix& fix = anna.position().reading().front();
  EXPECT_NEAR(fix.pose.x, 1.0, 1e-3);
  EXPECT_NEAR(fix.pose.theta, 0.5, 1e-3);
  EXPECT_NEAR(fix.covariance[0], 0.09 + kAdded * kAdded, 1e-4);
  EXPECT_EQ(anna.position().stamp(), fromSeconds(1.0));
  EXPECT_EQ(anna.places("robots").sequence(), 0U);
}

/// Two normal distributions in x: their product has the mean weighed by information.
TEST(Teammate, MatesThatAgreeAreOneFix) {
  Listener anna;
  anna.hear(1.0,
            {{0.0, "bert", toText(placeOf("anna", {1.0, 2.0, 0.0}, 0.3, 0.1, Place::kNoHeading))},
             {0.0, "carl", toText(placeOf("anna", {1.2, 2.0, 0.0}, 0.1, 0.3, Place::kNoHeading))}});
  ASSERT_EQ(anna.position().reading().size(), 1u);
  const PoseFixData::Fix& fix = anna.position().reading().front();
  const double a = 1.0 / (0.09 + kAdded * kAdded);
  const double b = 1.0 / (0.01 + kAdded * kAdded);
  EXPECT_NEAR(fix.pose.x, (a * 1.0 + b * 1.2) / (a + b), 2e-3);
  EXPECT_NEAR(fix.covariance[0], 1.0 / (a + b), 1e-4);
  EXPECT_NEAR(fix.covariance[4], 1.0 / (a + b), 1e-4);
  EXPECT_GT(fix.covariance[8], 100.0);  // nobody knows the heading
}

TEST(Teammate, HeadingsAreFusedAcrossTheHalfTurn) {
  constexpr double kPi = std::numbers::pi;
  Listener anna;
  anna.hear(1.0, {{0.0, "bert", toText(placeOf("anna", {1, 2, kPi - 0.1}, 0.1, 0.1, 0.2))},
                  {0.0, "carl", toText(placeOf("anna", {1, 2, -kPi + 0.1}, 0.1, 0.1, 0.2))}});
  ASSERT_EQ(anna.position().reading().size(), 1u);
  EXPECT_NEAR(std::abs(anna.position().reading().front().pose.theta), kPi, 2e-3);
}

TEST(Teammate, MatesThatContradictEachOtherStayBesideEachOther) {
  Listener anna;
  anna.hear(1.0, {{0.0, "bert", toText(placeOf("anna", {-3, 0, 0}, 0.2, 0.2, 0.1))},
                  {0.0, "carl", toText(placeOf("anna", {3, 0, 0}, 0.1, 0.1, 0.1))}});
  ASSERT_EQ(anna.position().reading().size(), 2u);
  EXPECT_NEAR(anna.position().reading()[0].pose.x, 3.0, 1e-3);  // the surer one first
  EXPECT_NEAR(anna.position().reading()[1].pose.x, -3.0, 1e-3);
}

/// Whoever served or recorded the robot has made it already, of more than is known here.
TEST(Teammate, WhatCameReadyMadeStays) {
  Listener anna;
  const Place bert = placeOf("bert", {1, 1, 0}, 0.1, 0.1, 0.1);
  const Place carl = placeOf("carl", {2, 2, 0}, 0.1, 0.1, 0.1);
  const std::vector<Message> frame = {
      {5, {"radio", "teammate", "talk"}, TalkData::encode({"anna", {{0.0, "bert", toText(bert)}}})},
      {5,
       {"radio", "teammate", "robots"},
       PlacesData::encode({{bert, 0.0, "bert"}, {carl, 0.5, "carl"}})}};
  anna.container.set(frame);
  EXPECT_EQ(anna.places("robots").reading().size(), 2u);
  EXPECT_EQ(anna.places("robots").sequence(), 1U);
}

TEST(Teammate, WhereOthersAre) {
  Listener anna("keep_s = 1");
  Place ball = placeOf("ball", {0, 0, 0}, 0.1, 0.1, Place::kNoHeading);
  ball.kind = Place::Kind::kBall;
  anna.hear(1.0, {{0.0, "bert", toText(placeOf("bert", {1, 1, 0}, 0.1, 0.1, 0.1))},
                  {0.0, "bert", toText(placeOf("carl", {2, 2, 0}, 0.3, 0.3, 0.1))},
                  {0.0, "bert", toText(ball)}});
  ASSERT_EQ(anna.places("robots").reading().size(), 2u);
  ASSERT_EQ(anna.places("balls").reading().size(), 1u);
  EXPECT_EQ(anna.places("balls").reading().front().from, "bert");
  // What carl says of himself is better, and stays so while it is new.
  anna.hear(1.2, {{0.1, "carl", toText(placeOf("carl", {2.1, 2.1, 0}, 0.1, 0.1, 0.1))}});
  anna.hear(1.4, {{0.0, "bert", toText(placeOf("carl", {2.4, 2.4, 0}, 0.3, 0.3, 0.1))}});
  ASSERT_EQ(anna.places("robots").reading().size(), 2u);
  const PlacesData::Told& carl = anna.places("robots").reading()[1];
  EXPECT_EQ(carl.place.name, "carl");
  EXPECT_NEAR(carl.place.fix.pose.x, 2.1, 1e-9);
  EXPECT_NEAR(carl.age, 0.3, 1e-6);
  anna.hear(2.15, {{0.0, "bert", toText(placeOf("carl", {2.4, 2.4, 0}, 0.3, 0.3, 0.1))}});
  ASSERT_EQ(anna.places("robots").reading().size(), 1u);  // bert is silent for longer than that
  EXPECT_NEAR(anna.places("robots").reading()[0].place.fix.pose.x, 2.4, 1e-9);
}

/// A hostile mate tells of more robots than there can be.
TEST(Teammate, AHostileMateFillsNoMemory) {
  Listener anna;
  for (int i = 0; i < 20; ++i) {
    std::vector<TalkData::Message> messages;
    for (int k = 0; k < 64; ++k)
      messages.push_back(
          {0.0, "m" + std::to_string(64 * i + k),
           toText(placeOf("r" + std::to_string(64 * i + k), {1, 1, 0}, 0.1, 0.1, 0.1))});
    anna.hear(1.0 + 0.01 * i, messages);
  }
  EXPECT_EQ(anna.places("robots").reading().size(), PlacesData::kMostPlaces);
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "ortung/refbox/WorldState.hpp"

namespace ortung::refbox {
namespace {

using nlohmann::json;

std::set<std::string> keysOf(const json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

WorldState full() {
  WorldState state{"ants", "attack", {}, {}, {}, 0.125};
  state.robots.push_back({3, {1, 2, 0.5}, {4, 5, 0.25}, {0.1, 0.2, 0.3}, "go", 0.75, true});
  state.balls.push_back({{1, 2, 0.11}, {0.5, 0, 0}, 0.9});
  state.obstacles.push_back({1, -1, 0.25, -0.25, 0.3, 0.8});
  return state;
}

TEST(WorldState, HasAllThatTheBoxWants) {
  const json message = json::parse(toJson(full()));
  EXPECT_EQ(keysOf(message), (std::set<std::string>{"type", "teamName", "intention", "robots",
                                                    "balls", "obstacles", "ageMs"}));
  EXPECT_EQ(message["type"], "worldstate");
  EXPECT_EQ(message["teamName"], "ants");
  EXPECT_EQ(message["ageMs"], 125);
  EXPECT_EQ(message["robots"], json::parse(R"([{"id": 3, "pose": [1.0, 2.0, 0.5],
      "targetPose": [4.0, 5.0, 0.25], "velocity": [0.1, 0.2, 0.3], "intention": "go",
      "batteryLevel": 0.75, "ballEngaged": true}])"));
  EXPECT_EQ(message["balls"], json::parse(R"([{"position": [1.0, 2.0, 0.11],
      "velocity": [0.5, 0.0, 0.0], "confidence": 0.9}])"));
  EXPECT_EQ(message["obstacles"], json::parse(R"([{"position": [1.0, -1.0],
      "velocity": [0.25, -0.25], "radius": 0.3, "confidence": 0.8}])"));
  EXPECT_EQ(toJson(full()).find('\0'), std::string::npos);
}

TEST(WorldState, ListsMayBeEmptyButAreThere) {
  const json message = json::parse(toJson({}));
  for (const char* list : {"robots", "balls", "obstacles"})
    EXPECT_EQ(message[list], json::array()) << list;
}

TEST(WorldState, NumbersThatAreNoneAreLeftOut) {
  WorldState state = full();
  state.robots.push_back({4, {NAN, 0, 0}});
  state.balls.push_back({{INFINITY, 0, 0}});
  state.obstacles.push_back({0, 0, 0, NAN});
  state.age = NAN;
  const std::string text = toJson(state);
  const json message = json::parse(text);
  EXPECT_EQ(message["robots"].size(), 1U);
  EXPECT_EQ(message["balls"].size(), 1U);
  EXPECT_EQ(message["obstacles"].size(), 1U);
  EXPECT_EQ(text.find("null"), text.npos);
}

TEST(WorldState, BytesThatAreNoTextAreReplaced) {
  WorldState state;
  state.teamName = "\xff\xfe";
  EXPECT_NO_THROW(json::parse(toJson(state)));
}

}  // namespace
}  // namespace ortung::refbox

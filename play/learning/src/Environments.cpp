#include "ortung/learning/Environments.hpp"

#include <algorithm>
#include <stdexcept>

#include "Observation.hpp"
#include "ortung/base/Nearest.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung::learning {
namespace {

std::vector<Quantity> observationOf(bool isLocalized) {
  std::vector<Quantity> all = {{"x", "m", -kFar, kFar},
                               {"y", "m", -kFar, kFar},
                               {"cos heading", "", -1, 1},
                               {"sin heading", "", -1, 1},
                               {"velocity forward", "m/s", -kFast, kFast},
                               {"velocity left", "m/s", -kFast, kFast},
                               {"velocity turn", "rad/s", -kFast, kFast},
                               {"time left", "s", 0, 120}};
  const auto addSeen = [&](const std::string& what) {
    all.push_back({what + " x", "m", -kFar, kFar});
    all.push_back({what + " y", "m", -kFar, kFar});
    all.push_back({what + " age", "s", 0, kOld});
  };
  for (std::size_t i = 0; i < kSights; ++i) addSeen("ball " + std::to_string(i));
  addSeen("other robot");
  if (isLocalized) {
    all.push_back({"sigma position", "m", 0, kFar});
    all.push_back({"sigma heading", "rad", 0, kFar});
    all.push_back({"is tracking", "", 0, 1});
  }
  return all;
}

const Quantity kForwardAction{"forward", "speed", -1, 1};
const Quantity kTurnAction{"turn", "3 rad/s", -1, 1};
const Quantity kKickAction{"kick if positive", "", -1, 1};

std::vector<OptionHelp> optionsOf(std::vector<OptionHelp> own, const char* observation,
                                  const char* observations, const char* duration) {
  own.push_back({"observation", observations, observation, "what an agent observes"});
  own.push_back({"action_s", "s", "0.1", "how long an action holds"});
  own.push_back({"cycle_ms", "5 to 20", "20", "cycle of the simulation"});
  own.push_back({"duration_s", "s", duration, "then the episode is truncated"});
  return own;
}

/// Names of the players that ship, and that others may be given.
std::string valuesOf(std::span<const std::string_view> names) {
  std::string all;
  for (const std::string_view name : names) all += std::string(name) + "|";
  return all + "a player's text";
}

std::vector<EnvironmentInfo> makeAll() {
  const std::vector<Quantity> keeps = {kForwardAction, kTurnAction};
  const std::vector<Quantity> strikes = {kForwardAction, kTurnAction, kKickAction};
  const OptionHelp keeperSpeed{"keeper_speed_m_s", "m/s", "1.5", "speed of the action forward = 1"};
  const OptionHelp strikerSpeed{"striker_speed_m_s", "m/s", "1", "speed of the action forward = 1"};
  const OptionHelp keeper{"keeper", valuesOf(goalkeeperPolicies()), "blocking", "the keeper"};
  OptionHelp stillKeeper = keeper;
  stillKeeper.fallback = "still";
  const OptionHelp striker{"striker", valuesOf(strikerKinds()), "yardstick-v1", "the striker"};
  const OptionHelp start{"start", "near|anywhere", "near",
                         "whether MCL gets the approximate start pose"};
  return {{"goalkeeper-v0",
           "keeps a goal against one attempt of a striker",
           {"keeper"},
           observationOf(false),
           {keeps},
           optionsOf({striker, keeperSpeed}, "features", "features|truth", "10")},
          {"striker-v0",
           "scores with the ball at its kicker against a keeper",
           {"striker"},
           observationOf(false),
           {strikes},
           optionsOf({keeper, strikerSpeed}, "features", "features|truth", "10")},
          {"keeper-vs-striker-v0",
           "a keeper and a striker against each other",
           {"keeper", "striker"},
           observationOf(false),
           {keeps, strikes},
           optionsOf({keeperSpeed, strikerSpeed}, "features", "features|truth", "10")},
          {"localize-and-score-v0",
           "takes the ball to the goal and scores by its MCL pose",
           {"striker"},
           observationOf(true),
           {strikes},
           optionsOf({stillKeeper, start, strikerSpeed}, "localized", "localized|features", "20")}};
}

const std::vector<EnvironmentInfo>& all() {
  static const std::vector<EnvironmentInfo> kAll = makeAll();
  return kAll;
}

}  // namespace

std::size_t EnvironmentInfo::actionSize() const {
  std::size_t most = 0;
  for (const auto& one : actions) most = std::max(most, one.size());
  return most;
}

std::span<const EnvironmentInfo> environments() { return all(); }

const EnvironmentInfo& environment(std::string_view id) {
  std::string known;
  std::vector<std::string> ids;
  for (const EnvironmentInfo& one : all()) {
    if (one.id == id) return one;
    known += (known.empty() ? "" : ", ") + one.id;
    ids.push_back(one.id);
  }
  throw std::invalid_argument("there is no environment '" + std::string(id) + "', expected " +
                              known + didYouMean(id, ids));
}

}  // namespace ortung::learning

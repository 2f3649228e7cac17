#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung::learning {

/// Values of options by key, as in Parameters.
using Options = std::map<std::string, Parameters::Node, std::less<>>;

/// A number of an observation or an action.
struct Quantity {
  std::string name;
  std::string unit;   ///< unit, "" if it has none
  float low = 0.0f;   ///< least value
  float high = 0.0f;  ///< greatest value
};

/// An option of an environment, for help texts and errors.
struct OptionHelp {
  std::string key;
  std::string values;    ///< unit, range or choices
  std::string fallback;  ///< default value
  std::string meaning;   ///< description
};

/// The description of an environment. An identifier stands for one behaviour for ever: any change
/// of it gets another version.
struct ORTUNG_API EnvironmentInfo {
  std::string id;                              ///< identifier, e.g. "goalkeeper-v0"
  std::string what;                            ///< description in one line
  std::vector<std::string> agents;             ///< names of its agents: "keeper", "striker"
  std::vector<Quantity> observation;           ///< numbers of each agent's observation
  std::vector<std::vector<Quantity>> actions;  ///< numbers of each agent's action
  std::vector<OptionHelp> options;

  /// Returns the number of values per agent in an array of actions: that of the largest action.
  std::size_t actionSize() const;
};

/// Returns all environments.
ORTUNG_API std::span<const EnvironmentInfo> environments();
/// Returns an environment. @throws std::invalid_argument naming those that exist
ORTUNG_API const EnvironmentInfo& environment(std::string_view id);

/// Computes the action of the shipped heuristic, which solves the environment by its observations
/// alone.
/// @param agent index among the environment's agents @param action out: the action
/// @throws std::invalid_argument for sizes that are not the environment's
ORTUNG_API void heuristic(const EnvironmentInfo& environment, std::size_t agent,
                          std::span<const float> observation, std::span<float> action);
/// Computes the action of a keeper that stays between the ball and the middle of its goal, by its
/// observations. Learners begin with it, or are compared with it.
ORTUNG_API void blocking(std::span<const float> observation, std::span<float> action);

}  // namespace ortung::learning

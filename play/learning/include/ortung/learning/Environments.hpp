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

/// Values by key: what Parameters hold.
using Options = std::map<std::string, Parameters::Node, std::less<>>;

/// One number of an observation or an action.
struct Quantity {
  std::string name;
  std::string unit;  ///< "" if it has none
  float low = 0.0f;
  float high = 0.0f;
};

/// One option of an environment, as texts and errors call it.
struct OptionHelp {
  std::string key;
  std::string values;
  std::string fallback;
  std::string meaning;
};

/// What somebody who learns must know of an environment. An identifier stands for one behaviour for
/// ever: what changes what an episode becomes gets another version.
struct ORTUNG_API EnvironmentInfo {
  std::string id;  ///< "goalkeeper-v0"
  std::string what;
  std::vector<std::string> agents;             ///< "keeper", "striker"
  std::vector<Quantity> observation;           ///< of each agent
  std::vector<std::vector<Quantity>> actions;  ///< by agent
  std::vector<OptionHelp> options;

  /// Numbers of an action in an array, where agents have places of one size.
  std::size_t actionSize() const;
};

/// All that there are.
ORTUNG_API std::span<const EnvironmentInfo> environments();
/// @throws std::invalid_argument naming those that there are
ORTUNG_API const EnvironmentInfo& environment(std::string_view id);

/// What a shipped heuristic does, which solves the environment by its observations alone.
/// @param agent its place among the environment's agents @param action out
/// @throws std::invalid_argument for sizes that are not the environment's
ORTUNG_API void heuristic(const EnvironmentInfo& environment, std::size_t agent,
                          std::span<const float> observation, std::span<float> action);
/// What a keeper does that blocks by its observations: stands between ball and middle of its goal.
/// What learners begin with, or are compared with.
ORTUNG_API void blocking(std::span<const float> observation, std::span<float> action);

}  // namespace ortung::learning

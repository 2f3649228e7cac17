#pragma once

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "BagFile.hpp"

namespace ortung::ros2 {

inline constexpr std::size_t kMostTopics = 1024;  ///< of a type that are read
inline constexpr std::string_view kRos1Encoding = "ros1";

/// Returns the feature of a channel in a file that Ortung wrote, or "".
std::string featureOf(const McapChannel& channel);
/// Returns the name that ROS 2 has for the type of a channel's messages, which ROS 1 calls
/// otherwise.
std::string typeOf(const McapChannel& channel);
/// Whether clouds are levelled by what is told at a topic of their own.
bool isLevelledByTopic(const std::string& level);
/// Returns names for an error: "'/scan', '/top'".
std::string listOf(const std::set<std::string>& names);

/// Returns the element of a list that is of a channel's topic; a new one, if there is none.
/// @param where file for the error @throws std::runtime_error for more than kMostTopics
template <class List>
auto& ofTopic(List& list, const McapChannel& channel, const std::string& where) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const auto& one) { return one.topic == channel.topic; });
  if (found != list.end()) return *found;
  if (list.size() >= kMostTopics)
    throw std::runtime_error(where + ": found more than " + std::to_string(kMostTopics) +
                             " topics of one type, expected fewer");
  auto& one = list.emplace_back();
  one.topic = channel.topic;
  one.feature = featureOf(channel);
  return one;
}

}  // namespace ortung::ros2

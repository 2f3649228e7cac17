#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {

/// The messages that some readings become, by topic.
inline std::map<std::string, std::string> told(RobotTopics& topics,
                                               const std::vector<Message>& frame) {
  std::map<std::string, std::string> found;
  topics.take(frame, [&](std::size_t topic, Timestamp, std::string_view cdr) {
    found[topics.topics()[topic].name] = cdr;
  });
  return found;
}

/// The message in CDR.
template <class M>
M read(const std::string& cdr) {
  std::string why;
  const auto message = fromCdr<M>(cdr, why);
  EXPECT_TRUE(message) << why;
  return message.value_or(M());
}

}  // namespace ortung::ros2

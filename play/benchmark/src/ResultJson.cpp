#include "ResultJson.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace ortung {

std::string hexadecimal(std::uint64_t word, int digits) {
  char text[24];
  std::snprintf(text, sizeof text, "%0*llx", digits, static_cast<unsigned long long>(word));
  return text;
}

Json toJson(const Interval& interval) {
  return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

std::int64_t whole(const Json& json, const std::string& what, std::int64_t low, std::int64_t high) {
  const bool isLow = json.is_number_integer() && !json.is_number_unsigned();
  const bool fits = json.is_number_unsigned()
                        ? high >= 0 && json.get<std::uint64_t>() <= static_cast<std::uint64_t>(high)
                        : isLow && json.get<std::int64_t>() <= high;
  if (!fits || json.get<std::int64_t>() < low)
    throw std::runtime_error(what + " is " + json.dump().substr(0, 40) + ", expected " +
                             std::to_string(low) + " to " + std::to_string(high));
  return json.get<std::int64_t>();
}

std::vector<std::string> namesOf(const Json& json) {
  auto names = json.get<std::vector<std::string>>();
  for (const std::string& name : names)
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }))
      throw std::runtime_error("the name " + Json(name).dump() +
                               " has control characters, expected a player's text");
  return names;
}

}  // namespace ortung

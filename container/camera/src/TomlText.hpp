#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace ortung {

/// The shortest text that reads as the same number, a float of TOML.
inline std::string tomlNumber(double number) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  std::string out(text, end);
  if (out.find_first_of(".en") == std::string::npos) out += ".0";
  return out;
}

inline std::string tomlLine(std::string_view key, double number) {
  return std::string(key) + " = " + tomlNumber(number) + "\n";
}

inline std::string tomlLine(std::string_view key, const std::vector<double>& numbers) {
  std::string line = std::string(key) + " = [";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) line += ", ";
    line += tomlNumber(numbers[i]);
  }
  return line + "]\n";
}

}  // namespace ortung

#include "Numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "Console.hpp"

namespace ortung::app {

std::vector<double> parseNumbers(const std::string& text, const std::string& option,
                                 const std::vector<std::string>& names) {
  std::vector<double> numbers;
  const char* place = text.data();
  const char* const end = place + text.size();
  while (place <= end) {
    double number = 0.0;
    const auto [behind, error] = std::from_chars(place, end, number);
    const bool ended = behind == end || *behind == ',';
    if (error != std::errc() || !ended || !std::isfinite(number)) break;
    numbers.push_back(number);
    if (behind == end && numbers.size() == names.size()) return numbers;
    place = behind + 1;
  }
  throw UsageError(fmt::format("{} is '{}', expected {} number{} \"{}\"", option, text,
                               names.size(), names.size() == 1 ? "" : "s", fmt::join(names, ",")));
}

}  // namespace ortung::app

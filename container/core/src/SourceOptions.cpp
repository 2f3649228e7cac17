#include "ortung/core/SourceOptions.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "ortung/base/Angles.hpp"

namespace ortung {

std::optional<std::vector<double>> parseNumbers(std::string_view text, char separator) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t end = std::min(text.find(separator), text.size());
    double number = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + end, number);
    if (error != std::errc{} || rest != text.data() + end || !std::isfinite(number))
      return std::nullopt;
    numbers.push_back(number);
    if (end == text.size()) return numbers;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> optionNumber(const Parameters& options, const std::string& key,
                                   const Range& range) {
  if (!options.has(key)) return std::nullopt;
  const std::string text = options.text(key);
  const auto numbers = parseNumbers(text);
  if (!numbers || numbers->size() != 1 || numbers->front() < range.low ||
      numbers->front() > range.high) {
    std::ostringstream what;
    what << "is \"" << text << "\", must be a number in [" << range.low << ", " << range.high
         << "]";
    options.fail(key, what.str());
  }
  return numbers->front();
}

double optionNumber(const Parameters& options, const std::string& key, double fallback,
                    const Range& range) {
  return optionNumber(options, key, range).value_or(fallback);
}

std::optional<Pose2> optionPose(const Parameters& options, const std::string& key) {
  if (!options.has(key)) return std::nullopt;
  const std::string text = options.text(key);
  const auto numbers = parseNumbers(text);
  if (!numbers || numbers->size() != 3)
    options.fail(key, "is \"" + text + "\", must be x,y,theta in metres and degrees");
  return Pose2{(*numbers)[0], (*numbers)[1], wrapAngle(radians((*numbers)[2]))};
}

}  // namespace ortung

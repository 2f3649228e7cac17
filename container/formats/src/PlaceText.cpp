// The text by which robots send each other the place of something.
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "TextWords.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/PlacesData.hpp"

namespace ortung {
namespace {

constexpr std::string_view kKinds[] = {"robot", "ball"};
constexpr std::size_t kNumbers = 9;
constexpr double kFarthest = 1e5;  ///< [m]
constexpr double kLeast = 1e-6;    ///< least sigma of a position [m] and of a heading [rad]

/// Cuts off the next word; empty at the end.
std::string_view nextWord(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  const std::size_t end = std::min(text.find(' ', begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::optional<double> numberIn(std::string_view word) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

/// Reads the text's numbers; those of an unknown heading are "-".
std::optional<std::array<double, kNumbers>> numbersIn(std::string_view& text, bool& hasHeading) {
  std::array<double, kNumbers> numbers{};
  hasHeading = true;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const std::string_view word = nextWord(text);
    if (word == "-" && (i == 2 || i == 5)) {
      hasHeading = false;
      continue;
    }
    const std::optional<double> number = numberIn(word);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

bool isPlausible(const std::array<double, kNumbers>& n) {
  const bool isPlace = std::abs(n[0]) <= kFarthest && std::abs(n[1]) <= kFarthest;
  const bool isSigma = n[3] >= 0.0 && n[4] >= 0.0 && n[5] >= 0.0 && n[3] <= kFarthest &&
                       n[4] <= kFarthest && n[5] <= degrees(Place::kNoHeading);
  return isPlace && isSigma && std::abs(n[6]) <= 1.0 && std::abs(n[7]) <= 1.0 &&
         std::abs(n[8]) <= 1.0;
}

}  // namespace

std::string toText(const Place& place) {
  if (!isName(place.name))
    throw std::invalid_argument("a place of '" + place.name +
                                "', expected a name of 1 to 64 characters of [A-Za-z0-9_.-]");
  const auto& c = place.fix.covariance;
  const double sx = std::sqrt(c[0]);
  const double sy = std::sqrt(c[4]);
  const double st = std::sqrt(c[8]);
  const auto correlation = [](double covariance, double a, double b) {
    return a > 0.0 && b > 0.0 ? covariance / (a * b) : 0.0;
  };
  const double all = place.fix.pose.x + place.fix.pose.y + place.fix.pose.theta + sx + sy + st +
                     c[1] + c[2] + c[5];
  if (!std::isfinite(all))
    throw std::invalid_argument("the place of '" + place.name + "' is not finite");
  char heading[32] = "-";
  char headingSigma[32] = "-";
  if (place.hasHeading()) {
    std::snprintf(heading, sizeof heading, "%.2f", degrees(wrapAngle(place.fix.pose.theta)));
    std::snprintf(headingSigma, sizeof headingSigma, "%.3f", degrees(st));
  }
  char text[256];
  std::snprintf(text, sizeof text, " %.3f %.3f %s %.4f %.4f %s %.3f %.3f %.3f", place.fix.pose.x,
                place.fix.pose.y, heading, sx, sy, headingSigma, correlation(c[1], sx, sy),
                place.hasHeading() ? correlation(c[2], sx, st) : 0.0,
                place.hasHeading() ? correlation(c[5], sy, st) : 0.0);
  return std::string(kKinds[static_cast<std::size_t>(place.kind)]) + " " + place.name + text;
}

std::optional<Place> placeIn(std::string_view text) {
  Place place;
  const std::string_view kind = nextWord(text);
  if (kind != kKinds[0] && kind != kKinds[1]) return std::nullopt;
  place.kind = kind == kKinds[0] ? Place::Kind::kRobot : Place::Kind::kBall;
  const std::string_view name = nextWord(text);
  if (!isName(name)) return std::nullopt;
  place.name = name;
  bool hasHeading = true;
  const auto numbers = numbersIn(text, hasHeading);
  if (!numbers || !nextWord(text).empty() || !isPlausible(*numbers)) return std::nullopt;
  const auto& n = *numbers;
  const double sx = std::max(n[3], kLeast);
  const double sy = std::max(n[4], kLeast);
  const double st = hasHeading ? std::max(radians(n[5]), kLeast) : Place::kNoHeading;
  place.fix.pose = {n[0], n[1], wrapAngle(radians(n[2]))};
  const double xy = n[6] * sx * sy;
  const double xt = hasHeading ? n[7] * sx * st : 0.0;
  const double yt = hasHeading ? n[8] * sy * st : 0.0;
  place.fix.covariance = {sx * sx, xy, xt, xy, sy * sy, yt, xt, yt, st * st};
  return place;
}

}  // namespace ortung

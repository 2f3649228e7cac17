#include "FixWords.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "FormatTools.hpp"

namespace ortung {
namespace {

constexpr std::uint32_t kWhole = 10000;                    // units per correlation of 1
constexpr double kMicro = 1e6;                             // per metre
constexpr double kFineDegrees = 1.8e6 / std::numbers::pi;  // 1/10000 degree per radian
constexpr double kLargest = 4e9;                           // greatest word of a sigma

std::uint32_t sigmaWord(double sigma, double perUnit) {
  return static_cast<std::uint32_t>(std::clamp(std::nearbyint(sigma * perUnit), 1.0, kLargest));
}

std::uint32_t correlationWord(double covariance, double a, double b) {
  const double share = a > 0.0 && b > 0.0 ? std::clamp(covariance / (a * b), -1.0, 1.0) : 0.0;
  return static_cast<std::uint32_t>(std::nearbyint(share * kWhole) + kWhole);
}

}  // namespace

void addFixWords(const PoseFixData::Fix& fix, std::vector<std::uint32_t>& words) {
  const auto& c = fix.covariance;
  const double x = std::sqrt(c[0]);
  const double y = std::sqrt(c[4]);
  const double theta = std::sqrt(c[8]);
  words.insert(words.end(),
               {words::fromSignedMetres(fix.pose.x), words::fromSignedMetres(fix.pose.y),
                words::fromAngle(fix.pose.theta), sigmaWord(x, kMicro), sigmaWord(y, kMicro),
                sigmaWord(theta, kFineDegrees), correlationWord(c[1], x, y),
                correlationWord(c[2], x, theta), correlationWord(c[5], y, theta)});
}

void checkFixWords(std::span<const std::uint32_t> w) {
  checkAngleWord(w[2]);
  if (w[3] == 0 || w[4] == 0 || w[5] == 0)
    throw std::invalid_argument("found a sigma of 0, expected at least 1");
  for (std::size_t i = 6; i < kWordsAFix; ++i)
    if (w[i] > 2 * kWhole)
      throw std::invalid_argument("found the correlation word " + std::to_string(w[i]) +
                                  ", expected at most 20000");
}

PoseFixData::Fix fixIn(std::span<const std::uint32_t> w) {
  PoseFixData::Fix fix;
  fix.pose = {words::toSignedMetres(w[0]), words::toSignedMetres(w[1]), words::toAngle(w[2])};
  const double s[3] = {w[3] / kMicro, w[4] / kMicro, w[5] / kFineDegrees};
  const auto correlation = [&](std::size_t i) {
    return (static_cast<double>(w[i]) - kWhole) / kWhole;
  };
  const double xy = correlation(6) * s[0] * s[1];
  const double xt = correlation(7) * s[0] * s[2];
  const double yt = correlation(8) * s[1] * s[2];
  fix.covariance = {s[0] * s[0], xy, xt, xy, s[1] * s[1], yt, xt, yt, s[2] * s[2]};
  return fix;
}

}  // namespace ortung

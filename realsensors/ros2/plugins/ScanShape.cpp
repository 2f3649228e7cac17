#include "ScanShape.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "FrameTree.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::size_t kMostBeams = 8192;
constexpr double kMostMetres = 1000.0;
constexpr double kLeastStep = 1e-6;  // [rad], of which no scanner has less

/// Interprets a range (REP 117): below the least or not a number is invalid; beyond the greatest
/// one nothing is seen.
float meaning(float range) {
  return range > 0.0F ? range : std::numeric_limits<float>::quiet_NaN();
}

/// Whether beams lie within some turns: wheels of scanners repeat beams, but not that often.
bool isWithinTurns(double step, std::size_t beams) {
  constexpr double kMostTurns = 2.0;
  return std::abs(step) * static_cast<double>(beams - 1) <= kMostTurns * kTurn;
}

}  // namespace

ScanShape::ScanShape(const LaserScan& first)
    : frame_(first.header.frame),
      first_(static_cast<double>(first.angleMin)),
      step_(static_cast<double>(first.angleIncrement)),
      told_(first.ranges.size()),
      beams_(first.ranges.size()) {
  if (!std::isfinite(first_) || !(std::abs(step_) >= kLeastStep) || std::abs(first_) > 2 * kTurn ||
      beams_ == 0 || !isWithinTurns(step_, beams_))
    throw std::invalid_argument("found " + std::to_string(beams_) + " beams from " +
                                std::to_string(first_) + " rad on, " + std::to_string(step_) +
                                " rad apart, expected at least one, within a turn");
  // Scanners that see all around repeat the first beam at the end.
  constexpr double kRounded = 0.01;  // beams
  const double inATurn = std::max(1.0, std::floor(kTurn / std::abs(step_) + kRounded));
  if (inATurn < static_cast<double>(beams_)) beams_ = static_cast<std::size_t>(inATurn);
  if (beams_ > kMostBeams)
    throw std::invalid_argument("found " + std::to_string(beams_) + " beams, expected at most " +
                                std::to_string(kMostBeams));
  const auto most = static_cast<double>(first.rangeMax);
  std::array<char, 32> text{};
  toldRange_.assign(text.data(), std::to_chars(text.data(), text.end(), first.rangeMax).ptr);
  if (std::isfinite(most) && most > 0.0 && most <= kMostMetres) maxRange_ = most;
}

bool ScanShape::isSame(const LaserScan& scan) const {
  return scan.ranges.size() == told_ && static_cast<double>(scan.angleMin) == first_ &&
         static_cast<double>(scan.angleIncrement) == step_;
}

std::vector<float> ScanShape::fit(const LaserScan& scan) const {
  std::vector<float> ranges(beams_, std::numeric_limits<float>::quiet_NaN());
  if (isSame(scan)) {
    std::transform(scan.ranges.begin(), scan.ranges.begin() + static_cast<std::ptrdiff_t>(beams_),
                   ranges.begin(), meaning);
    return ranges;
  }
  const auto first = static_cast<double>(scan.angleMin);
  const auto step = static_cast<double>(scan.angleIncrement);
  if (!std::isfinite(first) || !std::isfinite(step) || step * step_ <= 0.0 || scan.ranges.empty() ||
      !isWithinTurns(step, scan.ranges.size()))
    return {};
  bool isAny = false;
  for (std::size_t i = 0; i < beams_; ++i) {
    const double at = std::round((first_ + step_ * static_cast<double>(i) - first) / step);
    if (!(at >= 0.0 && at < static_cast<double>(scan.ranges.size()))) continue;
    ranges[i] = meaning(scan.ranges[static_cast<std::size_t>(at)]);
    isAny = true;
  }
  return isAny ? ranges : std::vector<float>();
}

Scanner ScanShape::scanner(bool isUpsideDown) const {
  Scanner scanner;
  scanner.beams = static_cast<int>(beams_);
  scanner.angleStep = std::min(std::abs(step_), kTurn / static_cast<double>(beams_));
  const double last = first_ + step_ * static_cast<double>(beams_ - 1);
  const double lowest = isUpsideDown ? -std::max(first_, last) : std::min(first_, last);
  scanner.firstAngle = std::abs(lowest) <= kTurn ? lowest : wrapAngle(lowest);
  return scanner;
}

double ScanShape::usefulRange() const {
  constexpr double kUseful = 30.0;  // [m]
  return maxRange_ > 0.0 ? plain(maxRange_) : kUseful;
}

}  // namespace ortung::ros2

#include "FaintScan.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

constexpr int kScale = 24;           ///< scale of both_: two channels, three lines, (1, 2, 1)
constexpr int kThin = 10;            ///< how far from its middle a thin line ends [px]
constexpr double kLeastStep = 4.0;   ///< least rise of a faint line, in [0, 255]
constexpr double kLeastNoise = 2.0;  ///< least rise / sigma of the floor
constexpr double kLeastSigma = 1.0;  ///< least sigma of the floor, in [0, 255]
constexpr std::size_t kApart = 4;    ///< places that are compared for it [px]
constexpr int kAround = 60;          ///< width beside a crossing that gives the floor's sigma [px]
constexpr int kBeside = 24;          ///< width beside it that gives its mean [px]
constexpr double kFloorBeside = 0.75;  ///< least share of floor there on the better side
constexpr double kMostUneven = 5.0;    ///< greatest rise above one side / above the other
constexpr double kAboveMean = 0.6;     ///< least rise above that mean / the rise above the sides

/// Whether a colour is green enough to be floor in glare, in shadow or in a blur.
bool isGreenish(int red, int green, int blue) {
  return 20 * std::max(red, blue) <= 21 * green && 25 * std::min(red, blue) <= 22 * green;
}

}  // namespace

void FaintScan::read(const ScanLine& line) {
  const auto n = static_cast<std::size_t>(line.count);
  for (auto* buffer : {&red_, &green_, &blue_, &both_}) buffer->assign(n, 0);
  isGreenish_.resize(n);
  greenish_.resize(n + 1);
  sum_.resize(n + 1);
  pairs_.resize(n + 1);
  changes_.resize(n + 1);
  int red[3] = {0, 0, 0}, green[3] = {0, 0, 0}, blue[3] = {0, 0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint8_t* p = line.first + i * line.step;
    const std::uint8_t* b = line.before + i * line.step;
    const std::uint8_t* a = line.after + i * line.step;
    red[0] = red[1], red[1] = red[2], red[2] = p[0] + b[0] + a[0];
    green[0] = green[1], green[1] = green[2], green[2] = p[1] + b[1] + a[1];
    blue[0] = blue[1], blue[1] = blue[2], blue[2] = p[2] + b[2] + a[2];
    isGreenish_[i] = isGreenish(red[2], green[2], blue[2]) ? 1 : 0;
    if (i < 2) continue;
    red_[i - 1] = red[0] + 2 * red[1] + red[2];
    green_[i - 1] = green[0] + 2 * green[1] + green[2];
    blue_[i - 1] = blue[0] + 2 * blue[1] + blue[2];
    both_[i - 1] = red_[i - 1] + blue_[i - 1];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t value = isGreenish_[i] != 0 ? both_[i] : 0;
    greenish_[i + 1] = greenish_[i] + isGreenish_[i];
    sum_[i + 1] = sum_[i] + value;
    const bool isPair = i >= kApart && isGreenish_[i] != 0 && isGreenish_[i - kApart] != 0;
    pairs_[i + 1] = pairs_[i] + (isPair ? 1 : 0);
    changes_[i + 1] = changes_[i] + (isPair ? std::abs(both_[i] - both_[i - kApart]) : 0);
  }
}

/// Goes on to one side as long as there may be floor, to where that is darkest.
std::optional<FaintScan::Valley> FaintScan::valleyBeside(int peak, int way) const {
  std::optional<Valley> valley;
  const int last = static_cast<int>(both_.size()) - 2;
  for (int i = peak + way, n = 0; n < kThin && i >= 1 && i <= last; i += way, ++n) {
    const auto k = static_cast<std::size_t>(i);
    if (isGreenish_[k] != 0) {
      if (!valley || both_[k] < valley->values) valley = Valley{i, both_[k]};
    } else if (valley) {
      break;
    }
  }
  return valley;
}

/// The floor's sigma from how much places near each other differ, which light and shadow do not
/// change, and a few lines hardly.
double FaintScan::sigmaOf(int from, int to) const {
  const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
  const int pairs = pairs_[b] - pairs_[a];
  if (pairs < 2) return 0.0;
  // Of a normal distribution the mean of |x| is 0.798 sigmas; a difference has two of them.
  return (changes_[b] - changes_[a]) / (0.798 * std::sqrt(2.0) * pairs);
}

std::optional<FaintCrossing> FaintScan::crossingAt(int peak,
                                                   std::span<const std::int32_t> floorSum) const {
  const int count = static_cast<int>(both_.size());
  const int top = both_[static_cast<std::size_t>(peak)];
  const auto floorIn = [&](int from, int to) {
    return floorSum[static_cast<std::size_t>(to)] - floorSum[static_cast<std::size_t>(from)];
  };
  const int from = std::max(0, peak - kBeside), to = std::min(count, peak + kBeside + 1);
  if (std::max(floorIn(from, peak), floorIn(peak, to)) < kFloorBeside * kBeside)
    return std::nullopt;
  const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
  const double above =
      top - static_cast<double>(sum_[b] - sum_[a]) / std::max(1, greenish_[b] - greenish_[a]);
  const double sigma = std::max(
      kScale * kLeastSigma, sigmaOf(std::max(0, peak - kAround), std::min(count, peak + kAround)));
  const double least = std::max(kScale * kLeastStep, kLeastNoise * sigma);
  // Most peaks are the floor's noise, and end here.
  if (above < kAboveMean * least) return std::nullopt;
  const auto left = valleyBeside(peak, -1);
  if (!left || top - left->values < least) return std::nullopt;
  const auto right = valleyBeside(peak, 1);
  if (!right || top - right->values < least) return std::nullopt;
  const Valley& side = left->values > right->values ? *left : *right;
  const double rise = top - side.values;
  if (above < kAboveMean * rise) return std::nullopt;
  if (top - std::min(left->values, right->values) > kMostUneven * rise) return std::nullopt;
  const double half = top - 0.5 * rise;
  const auto edge = [&](int way) {
    int i = peak;
    while (both_[static_cast<std::size_t>(i + way)] > half) i += way;
    const double inside = both_[static_cast<std::size_t>(i)];
    const double outside = both_[static_cast<std::size_t>(i + way)];
    return i + way * (inside - half) / (inside - outside);
  };
  const double begin = edge(-1), end = edge(1);
  const auto k = static_cast<std::size_t>(peak), s = static_cast<std::size_t>(side.at);
  return FaintCrossing{
      .middle = 0.5 * (begin + end),
      .width = end - begin,
      .step = rise / kScale,
      .evidence = rise / sigma,
      .red = 2.0 * (red_[k] - red_[s]) / kScale,
      .blue = 2.0 * (blue_[k] - blue_[s]) / kScale,
      .paintRise = rise / std::max(1, side.values),
      .greenRise = static_cast<double>(green_[k] - green_[s]) / std::max(1, green_[s])};
}

std::span<const FaintCrossing> FaintScan::find(const ScanLine& line,
                                               std::span<const std::int32_t> floorSum) {
  read(line);
  found_.clear();
  for (int i = 2; i + 2 < line.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (both_[k] <= both_[k - 1] || both_[k] < both_[k + 1]) continue;
    if (const auto crossing = crossingAt(i, floorSum)) found_.push_back(*crossing);
  }
  return found_;
}

}  // namespace ortung

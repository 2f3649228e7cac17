#include "ortung/devices/SteadyDelay.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace ortung {
namespace {

constexpr Timestamp kPart = 100'000;  ///< time of which the least difference is kept [us]
constexpr std::size_t kKept = 600;    ///< greatest number of such times: a minute
constexpr std::size_t kQuarters = 4;
constexpr double kSame = 20'000.0;    ///< range of the quarters that delays explain [us]
constexpr double kSameOfSpan = 0.01;  ///< range as a share of the span

}  // namespace

bool SteadyDelay::note(Timestamp arrival, double difference) {
  if (!least_.empty() && arrival - least_.back().begin < kPart) {
    least_.back().difference = std::min(least_.back().difference, difference);
    return false;
  }
  least_.push_back({arrival, difference});
  if (least_.size() > kKept) least_.pop_front();
  return true;
}

bool SteadyDelay::isSteadyFrom(std::size_t first) const {
  const Timestamp begin = least_[first].begin;
  const auto length = static_cast<double>(least_.back().begin - begin);
  std::array<double, kQuarters> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = first; i < least_.size(); ++i) {
    const double place = static_cast<double>(least_[i].begin - begin) / length;
    const auto quarter = static_cast<std::size_t>(place * kQuarters);
    double& its = least[std::min(quarter, kQuarters - 1)];
    its = std::min(its, least_[i].difference);
  }
  const auto [low, high] = std::minmax_element(least.begin(), least.end());
  return *high - *low <= std::max(kSame, kSameOfSpan * length);
}

/// Looks at spans that end now, each twice as long as the one before: the longer ones bear longer
/// delays, the shorter ones begin when a queue was emptied.
bool SteadyDelay::isSteadyFor(double span) const {
  if (least_.empty()) return false;
  const Timestamp newest = least_.back().begin;
  for (Timestamp length = fromSeconds(span);; length *= 2) {
    const auto behind =
        std::upper_bound(least_.begin(), least_.end(), newest - length,
                         [](Timestamp t, const Least& one) { return t < one.begin; });
    if (behind == least_.begin()) return false;
    if (isSteadyFrom(static_cast<std::size_t>(behind - least_.begin()) - 1)) return true;
  }
}

}  // namespace ortung

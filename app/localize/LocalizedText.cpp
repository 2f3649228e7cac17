#include "LocalizedText.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ortung::app {
namespace {

/// What the status waits for, as docs/method/trust.md has it; "" where the reason says it.
std::string_view needOf(TrackReason reason) {
  switch (reason) {
    case TrackReason::kUnconfirmed:
      return "; after a global start that takes some readings that fit on a metre of way";
    case TrackReason::kMayBeLate:
      return "; that takes a turn, or a change of speed";
    case TrackReason::kSeveralPlaces:
      return "; that takes a reading that tells them apart";
    default:
      return "";
  }
}

}  // namespace

void UpdateCount::add(const PoseEstimate& estimate) {
  ++updates_;
  if (!first_) first_ = estimate.stamp;
  last_ = estimate.stamp;
  if (estimate.status == TrackStatus::kTracking)
    ++tracked_;
  else
    ++reasons_[estimate.reason];
}

double UpdateCount::seconds() const { return first_ ? toSeconds(last_ - *first_) : 0.0; }

std::string UpdateCount::whyNotTracked() const {
  if (reasons_.empty() || 2 * tracked_ >= updates_) return "";
  const auto most = std::max_element(
      reasons_.begin(), reasons_.end(),
      [](const auto& one, const auto& other) { return one.second < other.second; });
  return fmt::format(
      "the run is {} updates long ({:.1f} s), {} of them tracked; of the others {}: "
      "{}{}",
      updates_, seconds(), tracked_, most->second, nameOf(most->first), needOf(most->first));
}

}  // namespace ortung::app

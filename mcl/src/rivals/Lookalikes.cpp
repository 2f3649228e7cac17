#include "Lookalikes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "BeliefTuning.hpp"
#include "Centre.hpp"
#include "MotionTuning.hpp"
#include "RivalsTuning.hpp"

namespace ortung {

using namespace tuning;

void Lookalikes::Place::add(double ratio, double part) {
  const double most = lead::kMostNatsOfAReading;
  const double r = std::min(part, 1.0) * std::clamp(ratio, -most, most);
  const double kept = 1.0 - 1.0 / lookalikes::kRemembered;
  sum *= kept;
  squares *= kept;
  count *= kept;
  const double mean = count > 0.0 ? sum / count : 0.0;
  sum += r;
  count += 1.0;
  if (count > 1.0) squares += (r - mean) * (r - sum / count);
}

double Lookalikes::Place::odds() const {
  const double byChance = lookalikes::kDeviations * std::sqrt(squares + lookalikes::kChance);
  return before + std::min(0.0, sum + byChance);
}

void Lookalikes::forget() {
  places_.clear();
  odometry_.reset();
}

std::size_t Lookalikes::poses() const {
  return places_.empty() ? 0 : (places_.size() + 1) * lookalikes::kTried;
}

void Lookalikes::follow(const Moment& moment) {
  const Pose2 before = std::exchange(estimate_, moment.estimate);
  const std::optional<Pose2> from = std::exchange(odometry_, moment.odometry);
  if (places_.empty()) return;
  const Pose2 motion =
      from && odometry_ ? inverse(*from) * *odometry_ : inverse(before) * estimate_;
  for (Place& place : places_) place.pose = place.pose * motion;
  exchange(before * motion, estimate_);
  alignFloors();
}

void Lookalikes::compare(const Moment& moment, const Evidence& evidence) {
  if (places_.empty()) return;
  const std::vector<double> logs = heights(evidence, moment.random);
  for (std::size_t i = 0; i < places_.size(); ++i)
    places_[i].add(logs[i + 1] - logs[0], moment.travelled / common::kIndependent);
  tidy();
}

/// If the estimate is at one of the places now, the place that it has left takes that one's part.
/// @param left where the robot was led by its motion from the last estimate
void Lookalikes::exchange(const Pose2& left, const Pose2& estimate) {
  const auto nearer = [&](const Place& a, const Place& b) {
    return apart(a.pose, estimate) < apart(b.pose, estimate);
  };
  const auto nearest = std::min_element(places_.begin(), places_.end(), nearer);
  if (!isSame(nearest->pose, estimate) || apart(left, estimate) <= apart(nearest->pose, estimate))
    return;
  *nearest = Place{left};
}

/// Puts places on other floors that are at the estimate's place there to exactly its pose.
void Lookalikes::alignFloors() {
  if (building_.isEmpty()) return;
  const Floor& here = building_.floorOf(estimate_.x);
  const Pose2 onFloor = here.fromField(estimate_);
  for (Place& place : places_) {
    const Floor& there = building_.floorOf(place.pose.x);
    if (&there != &here && isSame(there.fromField(place.pose), onFloor))
      place.pose = there.toField(onFloor);
  }
}

/// Lets each place climb to the pose near it at which the readings fit best.
/// @returns ln p(readings) there, and before that near the estimate, which does not move
std::vector<double> Lookalikes::heights(const Evidence& evidence, Random random) {
  constexpr std::size_t kTried = lookalikes::kTried;
  std::vector<Pose2> steps(kTried);  // the same for all, so that none has better luck
  for (std::size_t k = 1; k < kTried; ++k) {
    const double scale = k % 2 == 0 ? 1.0 : 0.3;
    steps[k] = {scale * lookalikes::kMetres * random.gaussian(),
                scale * lookalikes::kMetres * random.gaussian(),
                scale * lookalikes::kRadians * random.gaussian()};
  }
  SampleSet tried;
  tried.resize((places_.size() + 1) * kTried);
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const std::size_t at = i / kTried;
    const Pose2 pose = (at == 0 ? estimate_ : places_[at - 1].pose) * steps[i % kTried];
    tried.x[i] = static_cast<float>(pose.x);
    tried.y[i] = static_cast<float>(pose.y);
    tried.theta[i] = static_cast<float>(pose.theta);
  }
  std::vector<float> logs;
  evidence.weigh(tried, logs);
  std::vector<double> best;
  for (std::size_t at = 0; at <= places_.size(); ++at) {
    const auto first = logs.begin() + static_cast<std::ptrdiff_t>(at * kTried);
    const auto top = std::max_element(first, first + kTried);
    best.push_back(static_cast<double>(*top));
    const auto i = static_cast<std::size_t>(top - logs.begin());
    if (at > 0) places_[at - 1].pose = places_[at - 1].pose * steps[i % kTried];
  }
  return best;
}

/// Drops places that are ruled out, and those that are one with the estimate or with another.
void Lookalikes::tidy() {
  std::vector<Place> kept;
  for (const Place& place : places_) {
    const auto isThere = [&](const Place& other) { return isSame(other.pose, place.pose); };
    if (place.odds() > lookalikes::kRuledOut && !isSame(place.pose, estimate_) &&
        std::none_of(kept.begin(), kept.end(), isThere))
      kept.push_back(place);
  }
  places_ = std::move(kept);
}

void Lookalikes::add(std::span<const PoseEstimate> places) {
  for (const PoseEstimate& place : places.subspan(1)) {
    if (places_.size() >= lookalikes::kMost) return;
    const double odds = std::log(place.share / places.front().share);
    Place fresh{place.pose};
    fresh.before = std::clamp(odds, -lead::kMostNatsOfAReading, 0.0);
    places_.push_back(fresh);
  }
  tidy();
}

double Lookalikes::shareOfEstimate() const {
  double all = 1.0;
  for (const Place& place : places_) all += std::exp(place.odds());
  return 1.0 / all;
}

std::vector<double> Lookalikes::floorShares() const {
  std::vector<double> shares(building_.floors.size(), 0.0);
  const double own = shareOfEstimate();
  shares[floor()] = own;
  for (const Place& place : places_)
    shares[building_.floorAt(place.pose.x)] += own * std::exp(place.odds());
  return shares;
}

PoseDistance Lookalikes::reach(double rest) const {
  PoseDistance reach;
  for (const Place& place : places_) {
    if (std::exp(place.odds()) <= rest / static_cast<double>(places_.size())) continue;
    reach.metres = std::max(reach.metres, distance(place.pose, estimate_));
    reach.radians =
        std::max(reach.radians, std::abs(wrapAngle(place.pose.theta - estimate_.theta)));
  }
  return reach;
}

}  // namespace ortung

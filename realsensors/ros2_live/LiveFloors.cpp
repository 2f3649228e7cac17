#include "LiveFloors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace ortung::ros2 {
namespace {

constexpr double kMentioned = 0.01;  ///< least share of the belief that is told

std::string twoDigits(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", share);
  return text;
}

}  // namespace

void LiveFloors::enter(const Building& building, const std::string& floor) {
  const std::lock_guard lock(mutex_);
  std::string name = floor;
  if (name.empty() && present_) name = building_.floors[*present_].name;
  building_ = building;
  present_ = building_.find(name);
  shares_.clear();
}

void LiveFloors::follow(const PoseEstimate& estimate, std::vector<double> shares) {
  const std::lock_guard lock(mutex_);
  if (building_.isEmpty() || !std::isfinite(estimate.pose.x)) return;
  if (shares.size() != building_.floors.size()) return;  // of another building
  shares_ = std::move(shares);
  const std::size_t there = building_.floorAt(estimate.pose.x);
  if (estimate.status != TrackStatus::kLost && shares_[there] > kNearlyAll) present_ = there;
}

bool LiveFloors::goTo(const std::string& floor) {
  const std::lock_guard lock(mutex_);
  const auto found = building_.find(floor);
  if (found) present_ = found;
  return found.has_value();
}

std::string LiveFloors::name() const {
  const std::lock_guard lock(mutex_);
  return present_ ? building_.floors[*present_].name : "";
}

std::optional<Floor> LiveFloors::frame() const {
  const std::lock_guard lock(mutex_);
  if (building_.isEmpty()) return std::nullopt;
  return building_.floors[index()];
}

bool LiveFloors::isHere(const Pose2& inField) const {
  const std::lock_guard lock(mutex_);
  if (building_.isEmpty()) return true;
  return present_ && std::isfinite(inField.x) && building_.floorAt(inField.x) == *present_;
}

Pose2 LiveFloors::toField(const Pose2& pose) const {
  const std::lock_guard lock(mutex_);
  return building_.isEmpty() ? pose : building_.floors[index()].toField(pose);
}

Pose2 LiveFloors::fromField(const Pose2& inField) const {
  const std::lock_guard lock(mutex_);
  return building_.isEmpty() ? inField : building_.floors[index()].fromField(inField);
}

std::optional<Pose2> LiveFloors::carried(const Pose2& inField, const Building& to,
                                         const std::string& floor) const {
  const std::lock_guard lock(mutex_);
  Pose2 own = inField;
  std::string name = floor;
  if (!building_.isEmpty()) {
    const Floor& from = building_.floorOf(inField.x);
    own = from.fromField(inField);
    if (name.empty()) name = from.name;
  }
  if (to.isEmpty()) return own;
  const auto found = to.find(name);
  if (!found) return std::nullopt;
  return to.floors[*found].toField(own);
}

std::size_t LiveFloors::spread() const {
  return static_cast<std::size_t>(std::count_if(shares_.begin(), shares_.end(),
                                                [](double share) { return share >= kMentioned; }));
}

void LiveFloors::describe(DiagnosticArray::Status& status) const {
  const std::lock_guard lock(mutex_);
  if (building_.isEmpty()) return;
  status.values.push_back({"floor", present_ ? building_.floors[*present_].name : ""});
  if (spread() < 2) return;
  std::string shares;
  for (std::size_t i = 0; i < shares_.size(); ++i)
    if (shares_[i] >= kMentioned)
      shares +=
          (shares.empty() ? "" : ", ") + building_.floors[i].name + " " + twoDigits(shares_[i]);
  status.values.push_back({"floors", shares});
  status.message += "; on which floor is open: " + shares;
}

}  // namespace ortung::ros2

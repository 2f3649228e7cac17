#include "CheckedMotion.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace ortung {
namespace {

/// Returns whether all values are finite, without a branch per value, so that the loop vectorizes.
bool areFinite(std::span<const float> values) {
  constexpr std::uint32_t kExponent = 0x7F800000u;  // all ones mean infinite or NaN
  std::uint32_t bad = 0;
  for (const float value : values)
    bad |=
        static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent);
  return bad == 0;
}

bool areMoments(const MotionChange& change) {
  return isFinite(change.mean) &&
         std::ranges::all_of(change.covariance,
                             [](double value) { return std::isfinite(value); }) &&
         change.covariance[0] >= 0.0 && change.covariance[4] >= 0.0 && change.covariance[8] >= 0.0;
}

}  // namespace

CheckedMotion::CheckedMotion(std::unique_ptr<MotionModel> model, const std::string& plugin)
    : model_(std::move(model)), guard_("the motion plugin '" + plugin + "'") {
  takeDelay();
}
CheckedMotion::~CheckedMotion() = default;

void CheckedMotion::takeDelay() {
  if (!std::isfinite(model_->delay())) guard_.fail("delay", "it is not finite");
  setDelay(model_->delay());
}

void CheckedMotion::follow(Timestamp stamp, const OdometryView& reading) {
  guard_("follow", [&] { model_->follow(stamp, reading); });
}

std::optional<Pose2> CheckedMotion::odometryAt(Timestamp stamp) const {
  const auto pose = guard_("odometryAt", [&] { return model_->odometryAt(stamp); });
  if (pose && !isFinite(*pose)) guard_.fail("odometryAt", "the pose that it gave is not finite");
  return pose;
}

void CheckedMotion::forget() {
  guard_("forget", [&] { model_->forget(); });
}

void CheckedMotion::sampleMotion(const MovableSamples& samples, const Pose2& odometryChange,
                                 std::uint64_t seed, std::uint64_t stream,
                                 std::uint64_t first) const {
  guard_("sampleMotion",
         [&] { model_->sampleMotion(samples, odometryChange, seed, stream, first); });
  if (!areFinite(samples.x) || !areFinite(samples.y) || !areFinite(samples.theta))
    guard_.fail("sampleMotion", "samples are not finite any more");
}

std::optional<MotionChange> CheckedMotion::moments(const Pose2& odometryChange) const {
  const auto change = guard_("moments", [&] { return momentsOf(*model_, odometryChange); });
  if (change && !areMoments(*change))
    guard_.fail("moments", "they are not finite, or a variance is negative");
  return change;
}

void CheckedMotion::learnMotion(const Pose2& odometryChange, const Pose2& trueChange) {
  guard_("learnMotion", [&] { model_->learnMotion(odometryChange, trueChange); });
}

void CheckedMotion::endDrive() {
  guard_("endDrive", [&] { model_->endDrive(); });
}

double CheckedMotion::endLearning() {
  const double fit = guard_("endLearning", [&] { return model_->endLearning(); });
  if (!std::isfinite(fit)) guard_.fail("endLearning", "the fit that it gave is not finite");
  takeDelay();
  return fit;
}

Parameters CheckedMotion::settings() const {
  return guard_("settings", [&] { return model_->settings(); });
}

}  // namespace ortung

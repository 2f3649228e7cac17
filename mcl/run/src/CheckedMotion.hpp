#pragma once

#include <memory>
#include <string>

#include "ortung/core/PluginGuard.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/motion/MotionMoments.hpp"

namespace ortung {

/// A motion model as MCL and its learner call it: what it throws, and samples that are not finite
/// any more, are a PluginFailure that names it.
class CheckedMotion final : public MotionModel, public MotionMoments {
 public:
  CheckedMotion(std::unique_ptr<MotionModel> model, const std::string& plugin);
  ~CheckedMotion() override;

  void follow(Timestamp stamp, const OdometryView& reading) override;
  std::optional<Pose2> odometryAt(Timestamp stamp) const override;
  void forget() override;
  void sampleMotion(const MovableSamples& samples, const Pose2& odometryChange, std::uint64_t seed,
                    std::uint64_t stream, std::uint64_t first) const override;
  std::optional<MotionChange> moments(const Pose2& odometryChange) const override;
  void learnMotion(const Pose2& odometryChange, const Pose2& trueChange) override;
  void endDrive() override;
  double endLearning() override;
  Parameters settings() const override;

 private:
  void takeDelay();

  std::unique_ptr<MotionModel> model_;
  PluginGuard guard_;
};

}  // namespace ortung

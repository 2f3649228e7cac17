#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/BlurrableWeigher.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung::test {

/// 10 x 10 m of which the left 2 m are a wall.
inline FieldRegion hall() {
  FieldRegion region{
      {.originX = 0, .originY = 0, .cell = 0.1, .columns = 100, .rows = 100}, {}, {}};
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell)
    region.standable.push_back(region.grid.centreX(cell) > 2.0 ? 1 : 0);
  region.open = region.standable;
  return region;
}

struct Hill {
  Pose2 top;
  double logHeight;
};

/// The highest of Gaussian hills of which hardly any pose of a cover meets one, unless blurred.
class Hills final : public BlurrableWeigher {
 public:
  explicit Hills(std::vector<Hill> hills, const PoseResolution& sigma = {0.03, 0.02},
                 double floor = -1000.0)
      : hills_(std::move(hills)), sigma_(sigma), floor_(floor) {}
  std::shared_ptr<const BlurrableWeigher> blurred(const PoseResolution& spread) const override {
    const PoseResolution sigma{std::hypot(sigma_.metres, spread.metres),
                               std::hypot(sigma_.radians, spread.radians)};
    auto wider = std::make_shared<Hills>(hills_, sigma, floor_);
    wider->weighed_ = weighed_;
    return wider;
  }
  double nominalNanoseconds() const override { return 100.0; }
  std::size_t weighed() const { return *weighed_; }

 private:
  void weigh(const SampleView& poses, std::span<float> out) const override {
    *weighed_ += poses.size();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      double best = floor_;
      for (const Hill& hill : hills_) {
        const double way = std::hypot(poses.x[i] - hill.top.x, poses.y[i] - hill.top.y);
        const double turn = wrapAngle(poses.theta[i] - hill.top.theta);
        best = std::max(best, hill.logHeight - 0.5 * std::pow(way / sigma_.metres, 2) -
                                  0.5 * std::pow(turn / sigma_.radians, 2));
      }
      out[i] += static_cast<float>(best);
    }
  }
  std::vector<Hill> hills_;
  PoseResolution sigma_;
  double floor_;
  std::shared_ptr<std::atomic<std::size_t>> weighed_ =
      std::make_shared<std::atomic<std::size_t>>(0);
};

/// Any function of x, y, theta.
class ToldWeigher final : public Weigher {
 public:
  explicit ToldWeigher(std::function<double(double, double, double)> what)
      : what_(std::move(what)) {}

 private:
  void weigh(const SampleView& poses, std::span<float> out) const override {
    for (std::size_t i = 0; i < poses.size(); ++i)
      out[i] += static_cast<float>(what_(poses.x[i], poses.y[i], poses.theta[i]));
  }
  std::function<double(double, double, double)> what_;
};

inline std::shared_ptr<const Weigher> told(std::function<double(double, double, double)> what) {
  return std::make_shared<ToldWeigher>(std::move(what));
}

}  // namespace ortung::test

#include "ortung/vision/FloorScan.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kFirstRange = 0.3;  ///< range of the first step [m]
constexpr double kGrowth = 1.03;     ///< ratio of a step's range to that of the step before
constexpr double kSameBody = 0.35;   ///< greatest difference of neighbours' ranges on one body [m]

}  // namespace

FloorScan::FloorScan(const CameraView& view, const Config& config)
    : config_(config), size_(view.model().size()) {
  begins_.push_back(0);
  for (int k = 0; k < config.directions; ++k) {
    const double bearing = wrapAngle(k * kTurn / config.directions);
    for (double range = kFirstRange; range <= config.maxRange; range *= kGrowth) {
      const auto pixel = view.pixelOf({range * std::cos(bearing), range * std::sin(bearing), 0.0});
      if (!pixel || !view.model().contains(*pixel)) continue;
      const auto u = static_cast<std::size_t>(std::lround(pixel->u));
      const auto v = static_cast<std::size_t>(std::lround(pixel->v));
      steps_.push_back({range, v * static_cast<std::size_t>(size_.width) + u});
    }
    begins_.push_back(steps_.size());
  }
}

/// Returns the range from which on the floor is hidden [m]. Nothing: it is hidden nowhere or
/// everywhere (then the range is not known), or a ball hides it.
std::optional<double> FloorScan::firstHidden(const ImageView& image, const ColourTable& colours,
                                             std::span<const Step> steps) const {
  bool hasFloor = false;
  const Step* hidden = nullptr;
  for (const Step& step : steps) {
    const std::uint8_t* rgb = image.pixels + 3 * step.pixel;
    if (colours.isFloor(rgb)) {
      hasFloor = true;
      hidden = nullptr;
      continue;
    }
    if (colours.isBall(rgb)) return std::nullopt;
    if (hidden == nullptr) hidden = &step;
    if (hasFloor && step.range - hidden->range >= config_.leastDepth * std::max(1.0, hidden->range))
      return hidden->range;
  }
  return std::nullopt;
}

std::vector<FloorBody> FloorScan::find(const ImageView& image, const ColourTable& colours) const {
  std::vector<FloorBody> bodies;
  if (image.format != PixelFormat::kRgb || !(image.size == size_)) return bodies;
  const auto n = static_cast<std::size_t>(config_.directions);
  std::vector<std::optional<double>> ranges(n);
  for (std::size_t k = 0; k < n; ++k)
    ranges[k] = firstHidden(image, colours,
                            std::span(steps_).subspan(begins_[k], begins_[k + 1] - begins_[k]));
  const auto continues = [&](std::size_t k) {  // the body of the direction before
    const auto& a = ranges[(k + n - 1) % n];
    const auto& b = ranges[k % n];
    return a && b && std::abs(*a - *b) <= kSameBody;
  };
  std::size_t first = 0;  // a direction with which a body begins, so that none is cut into two
  while (first < n && continues(first)) ++first;
  for (std::size_t i = 0; i < n;) {
    const std::size_t k = (first + i) % n;
    if (!ranges[k]) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    double nearest = *ranges[k];
    while (end < n && continues(first + end)) {
      nearest = std::min(nearest, *ranges[(first + end) % n]);
      ++end;
    }
    const double turn = static_cast<double>(end - i) * kTurn / static_cast<double>(n);
    const double width = nearest * turn;
    if (width >= config_.leastWidth && width <= config_.mostWidth)
      bodies.push_back(
          {nearest,
           wrapAngle((static_cast<double>(first + i) - 0.5) * kTurn / static_cast<double>(n) +
                     0.5 * turn),
           width});
    i = end;
  }
  std::sort(bodies.begin(), bodies.end(),
            [](const FloorBody& a, const FloorBody& b) { return a.range < b.range; });
  return bodies;
}

}  // namespace ortung

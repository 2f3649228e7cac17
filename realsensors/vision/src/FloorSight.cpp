#include "ortung/vision/FloorSight.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ortung {
namespace {

constexpr double kLeastSigma = 0.02;  ///< error of paint and floor [m]
constexpr int kFloorRun = 12;         ///< consecutive floor pixels that are not random

}  // namespace

std::optional<FloorSight> floorSightOf(const CameraView& view, const Pixel& pixel,
                                       double pixelSigma) {
  const auto here = view.floorAt(pixel);
  const auto right = view.floorAt({pixel.u + 1.0, pixel.v});
  const auto below = view.floorAt({pixel.u, pixel.v + 1.0});
  if (!here || !right || !below) return std::nullopt;
  const double worst = std::max(std::hypot(right->x - here->x, right->y - here->y),
                                std::hypot(below->x - here->x, below->y - here->y));
  return FloorSight{here->x, here->y, std::hypot(kLeastSigma, pixelSigma * worst)};
}

double floorTopOf(const ImageView& image, const ColourTable& colours) {
  std::vector<int> tops;
  const auto pitch = static_cast<std::size_t>(image.size.width) * 3;
  const int mostGap = image.size.height / 8;  // greatest gap, made by a robot or a ball
  for (int k = 0; k < 100 && image.format == PixelFormat::kRgb; ++k) {
    const int u = (2 * k + 1) * image.size.width / 200;
    int run = 0;
    int top = image.size.height;
    for (int v = image.size.height - 1; v >= 0; --v) {
      const bool isFloor = colours.isFloor(image.pixels + static_cast<std::size_t>(v) * pitch +
                                           static_cast<std::size_t>(u) * 3);
      run = isFloor ? run + 1 : 0;
      if (run >= kFloorRun) top = v;
      if (top < image.size.height && top - v > mostGap) break;  // walls may be green, too
    }
    if (top < image.size.height) tops.push_back(top);
  }
  if (tops.empty()) return 0.5 * image.size.height;
  const auto fifth = tops.begin() + static_cast<std::ptrdiff_t>(tops.size() / 5);
  std::nth_element(tops.begin(), fifth, tops.end());
  return *fifth;
}

}  // namespace ortung

#include <algorithm>
#include <cmath>
#include <vector>

#include "ortung/vision/LineCalibration.hpp"

namespace ortung {
namespace {

constexpr double kLeastSigma = 0.02;  ///< of paint and floor [m]
constexpr int kFloorRun = 12;         ///< pixels of floor that are not by chance

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
  for (int k = 0; k < 100 && image.format == PixelFormat::kRgb; ++k) {
    const int u = (2 * k + 1) * image.size.width / 200;
    int run = 0;
    for (int v = image.size.height - 1; v >= 0; --v) {
      // From below: where the topmost long run of floor ends. Robots and lines are looked over.
      const bool isFloor = colours.isFloor(image.pixels + static_cast<std::size_t>(v) * pitch +
                                           static_cast<std::size_t>(u) * 3);
      run = isFloor ? run + 1 : 0;
      if (run >= kFloorRun && (tops.size() <= static_cast<std::size_t>(k) || tops.back() > v)) {
        tops.resize(static_cast<std::size_t>(k) + 1, image.size.height);
        tops.back() = v;
      }
    }
  }
  std::erase(tops, image.size.height);
  if (tops.empty()) return 0.5 * image.size.height;
  const auto tenth = tops.begin() + static_cast<std::ptrdiff_t>(tops.size() / 5);
  std::nth_element(tops.begin(), tenth, tops.end());
  return *tenth;
}

}  // namespace ortung

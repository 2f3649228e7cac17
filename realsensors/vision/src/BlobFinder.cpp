#include "ortung/vision/BlobFinder.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ortung {
namespace {

/// A disc fills pi / 4 of its bounding box; partly hidden or in bad light it fills less.
constexpr double kLeastFilled = 0.45;
constexpr double kMostStretched = 2.2;
/// Least and greatest ratio of a blob's area to the expected area of a ball.
constexpr double kSmallest = 0.3;
constexpr double kLargest = 2.2;

/// Returns the area [px] that a ball at a place fills, computed from the images of its sides.
std::optional<double> areaOfBall(const CameraView& view, const Point3& middle, double radius) {
  const double distance = std::hypot(middle.x, middle.y);
  if (distance < 1e-6) return std::nullopt;
  const double sideX = -middle.y / distance * radius;
  const double sideY = middle.x / distance * radius;
  const auto left = view.pixelOf({middle.x + sideX, middle.y + sideY, middle.z});
  const auto right = view.pixelOf({middle.x - sideX, middle.y - sideY, middle.z});
  const auto top = view.pixelOf({middle.x, middle.y, middle.z + radius});
  const auto bottom = view.pixelOf({middle.x, middle.y, middle.z - radius});
  if (!left || !right || !top || !bottom) return std::nullopt;
  const double across = std::hypot(left->u - right->u, left->v - right->v);
  const double along = std::hypot(top->u - bottom->u, top->v - bottom->v);
  // From above, a ball appears as tall as it is wide although its vertical axis appears shorter.
  return 0.25 * CV_PI * across * std::max(across, along);
}

}  // namespace

std::vector<Blob> findBlobs(const ImageView& image, const ColourTable& colours, ColourClass what,
                            double leastPixels) {
  std::vector<Blob> blobs;
  if (image.format != PixelFormat::kRgb) return blobs;
  const int step = image.size.width * image.size.height > 100000 ? 2 : 1;
  const auto bits = static_cast<std::uint8_t>(what);
  cv::Mat mask((image.size.height + step - 1) / step, (image.size.width + step - 1) / step, CV_8U);
  for (int row = 0; row < mask.rows; ++row) {
    const std::uint8_t* line = image.pixels + static_cast<std::size_t>(row * step) *
                                                  static_cast<std::size_t>(image.size.width) * 3;
    std::uint8_t* out = mask.ptr<std::uint8_t>(row);
    for (int column = 0; column < mask.cols; ++column)
      out[column] = (colours.at(line + 3 * column * step) & bits) != 0 ? 255 : 0;
  }
  cv::Mat labels, statistics, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8);
  for (int i = 1; i < count; ++i) {
    const double pixels = statistics.at<int>(i, cv::CC_STAT_AREA) * step * step;
    if (pixels < leastPixels) continue;
    Blob blob;
    blob.middle = {centroids.at<double>(i, 0) * step, centroids.at<double>(i, 1) * step};
    blob.uMin = statistics.at<int>(i, cv::CC_STAT_LEFT) * step;
    blob.vMin = statistics.at<int>(i, cv::CC_STAT_TOP) * step;
    blob.uMax = blob.uMin + statistics.at<int>(i, cv::CC_STAT_WIDTH) * step;
    blob.vMax = blob.vMin + statistics.at<int>(i, cv::CC_STAT_HEIGHT) * step;
    blob.pixels = pixels;
    blobs.push_back(blob);
  }
  std::sort(blobs.begin(), blobs.end(),
            [](const Blob& a, const Blob& b) { return a.pixels > b.pixels; });
  return blobs;
}

std::vector<SeenBall> findBalls(const ImageView& image, const ColourTable& colours,
                                const CameraView& view, double radius, double maxRange) {
  std::vector<SeenBall> balls;
  constexpr double kLeastPixels = 12.0;
  for (const Blob& blob : findBlobs(image, colours, ColourClass::kBall, kLeastPixels)) {
    const double width = blob.uMax - blob.uMin;
    const double height = blob.vMax - blob.vMin;
    if (blob.pixels < kLeastFilled * width * height ||
        std::max(width, height) > kMostStretched * std::min(width, height))
      continue;
    const auto middle = view.floorAt(blob.middle, radius);
    if (!middle) continue;
    const double range = std::hypot(middle->x, middle->y);
    if (range > maxRange) continue;
    const auto area = areaOfBall(view, *middle, radius);
    if (!area || blob.pixels < kSmallest * *area || blob.pixels > kLargest * *area) continue;
    balls.push_back({range, std::atan2(middle->y, middle->x)});
  }
  std::sort(balls.begin(), balls.end(),
            [](const SeenBall& a, const SeenBall& b) { return a.range < b.range; });
  return balls;
}

}  // namespace ortung

#include "ortung/vision/BlobFinder.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace ortung {
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
  return BallFinder(view, {.radius = radius, .maxRange = maxRange}).find(image, colours);
}

}  // namespace ortung

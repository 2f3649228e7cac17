#include "ortung/calibration/ImageFile.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace ortung {

void Picture::dot(const Pixel& at, int r, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  if (!(std::abs(at.u) < 1e6 && std::abs(at.v) < 1e6)) return;
  const int u0 = static_cast<int>(std::lround(at.u));
  const int v0 = static_cast<int>(std::lround(at.v));
  for (int v = std::max(0, v0 - r); v <= std::min(size.height - 1, v0 + r); ++v)
    for (int u = std::max(0, u0 - r); u <= std::min(size.width - 1, u0 + r); ++u) {
      std::uint8_t* p =
          pixels.data() + 3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(size.width) +
                               static_cast<std::size_t>(u));
      p[0] = red;
      p[1] = green;
      p[2] = blue;
    }
}

Picture readPicture(const std::filesystem::path& file) {
  cv::Mat image;
  try {
    image = cv::imread(file.string(), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  if (image.empty())
    throw std::runtime_error(file.string() + ": is not an image that can be read (JPEG, PNG, ...)");
  if (std::max(image.cols, image.rows) > ImageData::kMostSide)
    throw std::runtime_error(file.string() + ": has " + std::to_string(image.cols) + " x " +
                             std::to_string(image.rows) + " pixels, at most 4096 a side");
  Picture picture{{image.cols, image.rows}, {}};
  picture.pixels.resize(picture.view().bytes());
  cv::Mat rgb(image.rows, image.cols, CV_8UC3, picture.pixels.data());
  cv::cvtColor(image, rgb, cv::COLOR_BGR2RGB);
  return picture;
}

std::vector<std::uint8_t> toPng(const ImageView& image) {
  const int type = image.format == PixelFormat::kRgb ? CV_8UC3 : CV_8U;
  const cv::Mat rgb(image.size.height, image.size.width, type,
                    const_cast<std::uint8_t*>(image.pixels));  // it is only read
  cv::Mat bgr = rgb;
  if (image.format == PixelFormat::kRgb) cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", bgr, bytes))
    throw std::runtime_error("a picture can't be encoded as PNG");
  return bytes;
}

}  // namespace ortung

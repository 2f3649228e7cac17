#include "ortung/calibration/ImageFile.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "PictureHeader.hpp"
#include "ortung/base/InputFile.hpp"

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

namespace {

constexpr std::size_t kMostBytes = 256U << 20;
constexpr const char* kExpected = "expected a picture: JPEG, PNG, BMP, PGM or PPM";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

std::string readBytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto kind = std::filesystem::status(file, error).type();
  if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
    refuse(file, std::string("is no regular file, ") + kExpected);
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) refuse(file, why);
  const auto size = std::filesystem::file_size(file, error);
  if (!error && size > kMostBytes)
    refuse(file, "has " + std::to_string(size) + " bytes, expected a picture of at most 256 MiB");
  std::string bytes(static_cast<std::size_t>(error ? 0 : size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

/// Sends to nowhere what libraries print on stderr: the decoders print before they fail, and
/// whoever called says which file it was, and what is wrong with it.
class QuietErrors {
 public:
  QuietErrors() : kept_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
    std::fflush(stderr);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) ::close(nowhere);
  }
  ~QuietErrors() {
    std::fflush(stderr);
    if (kept_ < 0) return;
    ::dup2(kept_, STDERR_FILENO);
    ::close(kept_);
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  int kept_;
};

/// The pixels of a file whose header is sound; empty if the rest is not.
cv::Mat decode(const std::string& bytes) {
  const QuietErrors quiet;
  try {
    const cv::Mat all(1, static_cast<int>(bytes.size()), CV_8U,
                      const_cast<char*>(bytes.data()));  // it is only read
    return cv::imdecode(all, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

Picture readPicture(const std::filesystem::path& file) {
  const std::string bytes = readBytes(file);
  const auto header = headerSize(bytes);
  if (!header) refuse(file, std::string("has no header of a picture, ") + kExpected);
  if (header->width < 1 || header->height < 1 ||
      std::max(header->width, header->height) > ImageData::kMostSide)
    refuse(file, "has " + std::to_string(header->width) + " x " + std::to_string(header->height) +
                     " pixels, expected 1 to 4096 a side");
  const cv::Mat image = decode(bytes);
  if (image.cols != header->width || image.rows != header->height)
    refuse(file, "is damaged: its " + std::to_string(header->width) + " x " +
                     std::to_string(header->height) + " pixels can't be decoded");
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

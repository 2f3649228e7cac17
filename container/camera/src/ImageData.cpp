#include "ortung/camera/ImageData.hpp"

#include <bit>
#include <cstring>
#include <stdexcept>

namespace ortung {
namespace {

static_assert(std::endian::native == std::endian::little,
              "words hold pictures as they lie in memory");

std::size_t wordsOf(const ImageView& image) {
  return ImageData::kHeaderWords + (image.bytes() + 3) / 4;
}

std::string toText(ImageSize size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

}  // namespace

ImageData::ImageData(SensorId id, const Pose2& mount, std::optional<CameraView> camera)
    : SensorData(std::move(id), mount), camera_(std::move(camera)) {}

ImageData::~ImageData() = default;

ImageView ImageData::reading() const {
  if (sequence() == 0) return {};
  return viewOf(getData());
}

ImageView ImageData::viewOf(std::span<const std::uint32_t> words) {
  ImageView view;
  view.size = {static_cast<int>(words[0]), static_cast<int>(words[1])};
  view.format = static_cast<PixelFormat>(words[2]);
  view.pixels = reinterpret_cast<const std::uint8_t*>(words.data() + ImageData::kHeaderWords);
  return view;
}

void ImageData::start(ImageSize size, PixelFormat format, std::vector<std::uint32_t>& words) {
  const ImageView view{size, format, nullptr};
  if (size.width < 1 || size.height < 1 || size.width > kMostSide || size.height > kMostSide)
    throw std::invalid_argument("a picture of " + toText(size) +
                                " pixels, its sides must be 1 to " + std::to_string(kMostSide));
  words.resize(wordsOf(view));
  words[0] = static_cast<std::uint32_t>(size.width);
  words[1] = static_cast<std::uint32_t>(size.height);
  words[2] = static_cast<std::uint32_t>(format);
  words.back() = words.size() > kHeaderWords ? 0 : words.back();
}

std::span<std::uint8_t> ImageData::pixelsOf(std::vector<std::uint32_t>& words) {
  const ImageView view = viewOf(words);
  return {reinterpret_cast<std::uint8_t*>(words.data() + kHeaderWords), view.bytes()};
}

std::vector<std::uint32_t> ImageData::encode(const ImageView& image) {
  std::vector<std::uint32_t> words;
  start(image.size, image.format, words);
  std::memcpy(pixelsOf(words).data(), image.pixels, image.bytes());
  return words;
}

Format ImageData::format() const {
  Format format(kFormat);
  if (camera_)
    format.with("width", camera_->model().size().width)
        .with("height", camera_->model().size().height);
  return format;
}

std::string ImageData::wordsHelp() const {
  return "[width, height, bytes a pixel (1 grey, 3 red, green, blue), pixels row by row, four "
         "bytes a word, the first the lowest]" +
         (camera_ ? ", " + toText(camera_->model().size()) + " pixels" : std::string());
}

void ImageData::check(std::span<const std::uint32_t> words) const {
  if (words.size() < kHeaderWords)
    throw std::invalid_argument("has " + std::to_string(words.size()) +
                                " words, expected at least width, height and bytes a pixel");
  const auto isSide = [](std::uint32_t side) { return side >= 1 && side <= kMostSide; };
  if (!isSide(words[0]) || !isSide(words[1]))
    throw std::invalid_argument("is a picture of " + std::to_string(words[0]) + " x " +
                                std::to_string(words[1]) + " pixels, its sides must be 1 to " +
                                std::to_string(kMostSide));
  if (words[2] != 1 && words[2] != 3)
    throw std::invalid_argument("has " + std::to_string(words[2]) +
                                " bytes a pixel, expected 1 (grey) or 3 (red, green, blue)");
  const ImageView view = viewOf(words);
  if (words.size() != wordsOf(view))
    throw std::invalid_argument("has " + std::to_string(words.size()) + " words, expected " +
                                std::to_string(wordsOf(view)) + " for a picture of " +
                                toText(view.size) + " pixels");
  if (camera_ && !(camera_->model().size() == view.size))
    throw std::invalid_argument("is a picture of " + toText(view.size) +
                                " pixels, but the camera is calibrated for " +
                                toText(camera_->model().size()));
}

void ImageData::decode(std::span<const std::uint32_t>) {}

}  // namespace ortung

#include "ortung/pictures/CameraPicture.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "Resampling.hpp"
#include "SensorEffects.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung {
namespace {

CameraView checked(CameraView camera) {
  const ImageSize size = camera.model().size();
  if (size.width > ImageData::kMostSide || size.height > ImageData::kMostSide)
    throw std::invalid_argument("a camera of " + std::to_string(size.width) + " x " +
                                std::to_string(size.height) +
                                " pixels can't be drawn, expected at most " +
                                std::to_string(ImageData::kMostSide) + " to a side");
  return camera;
}

}  // namespace

struct CameraPicture::Effects {
  Effects(const SensorEffects& all, ImageSize size)
      : share(static_cast<std::uint32_t>(std::lround(256.0F * all.blur))), rows(all, size) {}
  std::uint32_t share;  ///< share of a pixel's light that goes to each neighbour, of 256
  EffectRows rows;
  std::vector<std::uint32_t> row;
};

CameraPose cameraPoseOf(const CameraView& camera, const Pose2& sensor) {
  CameraPose pose;
  pose.position = {sensor.x, sensor.y, camera.place().z};
  const double c = std::cos(sensor.theta);
  const double s = std::sin(sensor.theta);
  const std::array<double, 9>& rows = camera.axes();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    pose.axes[axis] = c * rows[3 * axis] - s * rows[3 * axis + 1];
    pose.axes[3 + axis] = s * rows[3 * axis] + c * rows[3 * axis + 1];
    pose.axes[6 + axis] = rows[3 * axis + 2];
  }
  return pose;
}

CameraPicture::CameraPicture(CameraView camera, const Variation& variation)
    : camera_(checked(std::move(camera))), sheet_(camera_.model()) {
  setVariation(variation);
}

CameraPicture::~CameraPicture() = default;

void CameraPicture::setVariation(const Variation& variation) {
  lighting_ = lightingOf(variation);
  effects_.reset();
  if (variation.strength > 0.0)
    effects_ = std::make_unique<Effects>(effectsOf(variation), sheet_.picture());
}

Drawing CameraPicture::drawing(const Pose2& sensor, RobotNumber self) const {
  Drawing drawing;
  drawing.camera = cameraPoseOf(camera_, sensor);
  drawing.faces = sheet_.faces();
  drawing.width = sheet_.size().width;
  drawing.height = sheet_.size().height;
  drawing.ignore = self;
  drawing.lighting = lighting_;
  return drawing;
}

void CameraPicture::take(const World& world, const Pose2& sensor, RobotNumber self,
                         const std::optional<Noise>& noise, std::vector<std::uint32_t>& words) {
  const ImageSize size = sheet_.size();
  colours_.resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  Sheet sheet;
  sheet.colours = colours_;
  world.draw(drawing(sensor, self), sheet);
  sheet_.blacken(colours_);
  ImageData::start(sheet_.picture(), PixelFormat::kRgb, words);
  develop(noise, ImageData::pixelsOf(words));
}

void CameraPicture::develop(const std::optional<Noise>& noise, std::span<std::uint8_t> rgb) {
  const auto width = static_cast<std::size_t>(sheet_.picture().width);
  const int height = sheet_.picture().height;
  const bool isBlurred = effects_ && effects_->share > 0;
  std::optional<EffectRows::Noise> numbers;
  if (noise) numbers = EffectRows::Noise{noise->seed, noise->stream};
  if (isBlurred) {
    pixels_.resize(width * static_cast<std::size_t>(height));
    sheet_.resample(colours_, 0, height, pixels_);
    blur(pixels_, sheet_.picture(), effects_->share, effects_->row);
  } else {
    pixels_.resize(width);
  }
  for (int row = 0; row < height; ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * width;
    std::span<const std::uint32_t> pixels;
    if (isBlurred) {
      pixels = std::span<const std::uint32_t>(pixels_).subspan(first, width);
    } else if (sheet_.isPicture()) {
      pixels = std::span<const std::uint32_t>(colours_).subspan(first, width);
    } else {
      sheet_.resample(colours_, row, 1, pixels_);
      pixels = pixels_;
    }
    const std::span<std::uint8_t> out = rgb.subspan(3 * first, 3 * width);
    packRgb(pixels, out.data());
    if (effects_) effects_->rows.apply(row, numbers, out);
  }
}

void CameraPicture::annotate(const World& world, const Pose2& sensor, RobotNumber self,
                             std::span<std::uint32_t> things, std::span<float> ranges) {
  const auto size = static_cast<std::size_t>(sheet_.size().width) *
                    static_cast<std::size_t>(sheet_.size().height);
  things_.resize(things.empty() ? 0 : size);
  ranges_.resize(ranges.empty() ? 0 : size);
  Sheet sheet;
  sheet.things = things_;
  sheet.ranges = ranges_;
  world.draw(drawing(sensor, self), sheet);
  if (!things.empty()) sheet_.pick(things_, 0, things);
  if (!ranges.empty()) sheet_.pick(ranges_, std::numeric_limits<float>::infinity(), ranges);
}

}  // namespace ortung

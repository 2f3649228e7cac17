#include "ortung/pictures/CameraPicture.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "Faces.hpp"
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
      : blurred(static_cast<std::uint32_t>(std::lround(256.0F * all.blur)), size.width),
        rows(all, size) {}
  BlurredRows blurred;
  EffectRows rows;
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

/// Returns a row of the picture before all effects. Rows that are composed stay valid for three.
const std::uint32_t* CameraPicture::drawnRow(int row) {
  const auto width = static_cast<std::size_t>(sheet_.picture().width);
  if (sheet_.isPicture()) return colours_.data() + static_cast<std::size_t>(row) * width;
  const auto place = static_cast<std::size_t>(row % kRows) * width;
  const std::span<std::uint32_t> out = std::span(composed_).subspan(place, width);
  sheet_.resample(colours_, row, 1, out);
  return out.data();
}

void CameraPicture::develop(const std::optional<Noise>& noise, std::span<std::uint8_t> rgb) {
  const auto width = static_cast<std::size_t>(sheet_.picture().width);
  const int height = sheet_.picture().height;
  composed_.resize(sheet_.isPicture() ? 0 : kRows * width);
  std::optional<EffectRows::Noise> numbers;
  if (noise) numbers = EffectRows::Noise{noise->seed, noise->stream};
  const std::uint32_t* above = nullptr;
  const std::uint32_t* here = drawnRow(0);
  for (int row = 0; row < height; ++row) {
    const std::uint32_t* const below = row + 1 < height ? drawnRow(row + 1) : here;
    std::span<const std::uint32_t> pixels(here, width);
    if (effects_ && !effects_->blurred.isSharp())
      pixels = effects_->blurred.blur(row > 0 ? above : here, here, below);
    const std::span<std::uint8_t> out =
        rgb.subspan(3 * width * static_cast<std::size_t>(row), 3 * width);
    packRgb(pixels, out.data());
    if (effects_) effects_->rows.apply(row, numbers, out);
    above = here;
    here = below;
  }
}

void CameraPicture::annotate(const World& world, const Pose2& sensor, RobotNumber self,
                             std::span<std::uint32_t> things, std::span<float> ranges) {
  if (rays_.empty())
    for (const Point3& ray : PixelRays(camera_.model()).rays)
      rays_.push_back(
          {static_cast<float>(ray.x), static_cast<float>(ray.y), static_cast<float>(ray.z)});
  world.trace({cameraPoseOf(camera_, sensor), rays_, self}, {things, ranges});
}

}  // namespace ortung

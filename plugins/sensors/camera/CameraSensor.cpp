#include <optional>
#include <vector>

#include "CameraSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/pictures/CameraPicture.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

/// Approximate number of pixels that are drawn in the time of a ray.
constexpr double kPixelsARay = 4.0;

class CameraSensor : public Sensor {
 public:
  explicit CameraSensor(const Parameters& p) : settings_(readCameraSettings(p)) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    // It is made at the first use: its table is large, and most cameras of a simulation are never
    // used.
    if (!picture_)
      picture_.emplace(settings_.camera, Variation{settings_.variation, settings_.seed});
    std::optional<CameraPicture::Noise> numbers;
    if (noise != nullptr) numbers = CameraPicture::Noise{word(*noise), word(*noise)};
    picture_->take(world, robot.pose * settings_.mounting.pose, robot.number, numbers, words_);
    for (SensorData* one : data) one->setData(now, words_);
  }

  double period() const override { return settings_.period; }
  bool isOnDemand() const override { return true; }
  double rays() const override {
    const ImageSize size = settings_.camera.model().size();
    return static_cast<double>(size.width) * size.height / kPixelsARay;
  }

 private:
  static std::uint64_t word(Random& random) {
    const std::uint64_t high = random.next();
    return high << 32 | random.next();
  }

  CameraSettings settings_;
  std::optional<CameraPicture> picture_;
  std::vector<std::uint32_t> words_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("camera_sensor", ortung::provide<ortung::Sensor, ortung::CameraSensor>("camera"));

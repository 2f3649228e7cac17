#include "ortung/emulators/EmulatedBase.hpp"

#include <cmath>
#include <stdexcept>

#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

constexpr Timestamp kStops = 500'000;  ///< without a command [us]

}  // namespace

EmulatedBase::EmulatedBase(std::span<const SensorData* const> features, int baud)
    : baud_(baud), lines_(base_lines::kLongest) {
  for (const SensorData* data : features) {
    const Format format = data->format();
    if (format.name() == formats::kCone)
      sonars_.push_back({data->id(), format.number("max_m")});
    else if (format.name() == formats::kOdometry && !odometry_)
      odometry_ = data->id();
    else
      throw std::invalid_argument(toText(data->id()) + " is neither a sonar nor the only odometry");
  }
}

std::uint32_t EmulatedBase::timeOf(Timestamp now) const {
  return static_cast<std::uint32_t>(clock.at(now) / 1000);
}

void EmulatedBase::receive(std::string_view bytes, Timestamp now) {
  lines_.add(bytes);
  while (const auto line = lines_.next()) {
    const auto telegram = base_lines::decode(*line);
    if (!telegram) continue;
    if (std::holds_alternative<base_lines::Question>(*telegram)) {
      wasAsked_ = true;
      dropOutput(now);
      send(base_lines::encode(base_lines::Identity{1, sonars_.size()}), now);
    } else if (const auto* velocity = std::get_if<base_lines::Velocity>(&*telegram)) {
      velocity_ = *velocity;
      toldAt_ = now;
    }
  }
}

void EmulatedBase::sense(const Message& reading, Timestamp now) {
  if (reading.words.empty()) return;
  if (odometry_ && reading.id == *odometry_) {
    OdometryData data(reading.id);
    data.setData(reading.stamp, reading.words);
    const OdometryData::Reading& wheels = data.reading();
    send(base_lines::encode(base_lines::Odometry{
             timeOf(now), wheels.pose, wheels.translationalVelocity, wheels.rotationalVelocity,
             wheels.lateralVelocity, wheels.motionData}),
         now);
    return;
  }
  for (std::size_t i = 0; i < sonars_.size(); ++i) {
    if (reading.id != sonars_[i].id) continue;
    const std::uint32_t word = reading.words.front();
    if (word == 0) return;  // it did not measure
    const bool isNothing = word >= std::lround(1000.0 * sonars_[i].maxRange);
    send(base_lines::encode(base_lines::Sonars{timeOf(now), i, {isNothing ? 0U : word}}), now);
    return;
  }
}

std::optional<base_lines::Velocity> EmulatedBase::command(Timestamp now) const {
  if (!toldAt_ || now - *toldAt_ > kStops) return std::nullopt;
  return velocity_;
}

}  // namespace ortung

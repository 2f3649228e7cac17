#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// Objects that may be anywhere: balls, robots, obstacles. Since they move, they say nothing about
/// the robot's own pose: this feature neither learns nor localizes.
/// Words: five an object: identity (0: not known), colour, [mm], [angle], radius [mm];
/// none: looked and saw nothing. A colour is 0xRRGGBB, or kNoColour.
/// Not thread-safe, see SensorData.
class ORTUNG_API ObjectsData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kObjects;
  static constexpr std::uint32_t kNoColour = 1u << 24;
  static constexpr std::size_t kMostObjects = 1024;
  struct Object {
    std::uint32_t identity = 0;        ///< number of the object; zero: not known
    std::uint32_t colour = kNoColour;  ///< colour as 0xRRGGBB, or kNoColour
    double range = 0.0;                ///< distance to the object's middle along the floor [m]
    double bearing = 0.0;              ///< bearing of its middle in the sensor's frame [rad]
    double radius = 0.0;               ///< radius on the floor [m]
  };
  using Reading = std::vector<Object>;

  explicit ObjectsData(SensorId id, const Pose2& mount = {});
  ~ObjectsData() override;

  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(std::span<const Object> objects);
  static void encode(std::span<const Object> objects, std::vector<std::uint32_t>& words);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading reading_;
};

}  // namespace ortung

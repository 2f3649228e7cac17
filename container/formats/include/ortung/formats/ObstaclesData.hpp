#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// Outlines of what is in the way, as circles and straight segments. They may move, so they
/// neither learn nor localize.
/// Words: five an obstacle: 0, middle x, y [signed mm], radius [mm], 0 for a circle;
/// 1, x, y, x, y of both ends [signed mm] for a segment; none: looked and saw nothing.
/// Not thread-safe, see SensorData.
class ORTUNG_API ObstaclesData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kObstacles;
  static constexpr std::size_t kMostObstacles = 1024;
  enum class Shape : std::uint32_t { kCircle = 0, kSegment = 1 };
  struct Obstacle {
    Shape shape = Shape::kCircle;
    double x = 0.0;       ///< middle of a circle, or one end, in the sensor's frame [m]
    double y = 0.0;       ///< [m]
    double radius = 0.0;  ///< radius of a circle [m]
    double endX = 0.0;    ///< other end of a segment [m]
    double endY = 0.0;    ///< [m]
  };
  using Reading = std::vector<Obstacle>;

  explicit ObstaclesData(SensorId id, const Pose2& mount = {});
  ~ObstaclesData() override;

  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(std::span<const Obstacle> obstacles);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading reading_;
};

}  // namespace ortung

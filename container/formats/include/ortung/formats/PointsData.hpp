#pragma once

#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/LearnedData.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Points that can't be told apart, e.g. where scan lines of an image cross the field's lines, or
/// goals that look alike. Words: two a point: [mm] along the floor, [angle]; none: looked and saw
/// nothing.
/// Learns an end-point field: a point is probable where one was seen from anywhere. A point that is
/// not seen says nothing: it may be hidden. expectation() is the distance [m] to the nearest
/// learned point for each point of the reading, as if it were seen from there.
/// Not thread-safe, see SensorData.
class ORTUNG_API PointsData : public LearnedData {
 public:
  static constexpr const char* kFormat = formats::kPoints;
  struct Config {
    double maxRange = 6.0;     ///< points beyond it neither learn nor weigh [m]
    double fieldOfView = 0.0;  ///< the sensor's whole field of view [rad]; 0 or 2 pi: all around
    int usedPoints = 0;        ///< most points that weigh, evenly picked; 0: all
    double cell = 0.05;        ///< edge of the end-point field's cell [m]
    double margin = 1.0;       ///< greatest distance of points beyond the field's bounds [m]
    SensorModel model{.sigma = 0.1, .sigmaPerMetre = 0.05, .exponent = 0.3};
  };
  struct Point {
    double range = 0.0;    ///< range along the floor [m]
    double bearing = 0.0;  ///< bearing in the sensor's frame [rad]
  };
  using Reading = std::vector<Point>;
  static constexpr std::size_t kMostPoints = 4096;

  PointsData(SensorId id, const Pose2& mount, const Config& config);
  ~PointsData() override;

  const Reading& reading() const { return reading_; }
  const Config& config() const { return config_; }
  static std::vector<std::uint32_t> encode(std::span<const Point> points);
  static void encode(std::span<const Point> points, std::vector<std::uint32_t>& words);

  Format format() const override;
  std::string wordsHelp() const override;
  /// Returns nothing: the distance of each point from a learned one should be 0.
  std::vector<double> measured(const Pose2&) const override { return {}; }
  bool isAngle(std::size_t) const override { return false; }
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;

  Config config_;
  Reading reading_;
};

}  // namespace ortung

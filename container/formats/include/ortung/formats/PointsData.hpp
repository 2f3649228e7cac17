#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

struct EndPointTables;

/// Points that can't be told apart, e.g. where scan lines of an image cross the field's lines, or
/// goals that look alike. Words: two a point: [mm] along the floor, [angle]; none: looked and saw
/// nothing.
/// Learns an end-point field: a point is probable where one was seen from anywhere. A point that is
/// not seen says nothing: it may be hidden. Not thread-safe, see SensorData.
class ORTUNG_API PointsData : public SensorData {
 public:
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

  /// Makes a feature of this class with the words and parameters of another one that has this
  /// format, whatever its class; null if its format is another one (readingAs()).
  static std::unique_ptr<PointsData> like(const SensorData& feature);
  Format format() const override;
  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override;
  /// Returns the distance [m] to the nearest learned point for each point of the reading, as if it
  /// were seen from @p pose.
  std::vector<double> expectation(const Pose2& pose) const override;
  /// Returns nothing: the distance of each point from a learned one should be 0.
  std::vector<double> measured(const Pose2&) const override { return {}; }
  bool isAngle(std::size_t) const override { return false; }
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void finishTables() override;
  void useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                 const FieldGrid& grid) override;
  std::shared_ptr<const Weigher> makeWeigher() const override;

  Config config_;
  std::shared_ptr<EndPointTables> tables_;
  Reading reading_;
};

}  // namespace ortung

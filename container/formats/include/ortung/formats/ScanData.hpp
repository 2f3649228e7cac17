#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/tables/DirectionTable.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

struct EndPointTables;
class SurfaceField;

/// Ranges at evenly spaced bearings, counter-clockwise. Words: one [mm] a beam; 0: no valid
/// measurement; at or above the greatest range: nothing seen.
/// Learns a ray table or an end-point field. Not thread-safe, see SensorData.
class ORTUNG_API ScanData : public SensorData {
 public:
  /// Which table expectations come from: ranges of rays, or places of their end points.
  enum class Perception { kRays, kEndPoints };
  struct Config {
    int beams = 180;          ///< number of beams, 1 to 8192
    double firstAngle = 0.0;  ///< angle of beam 0 in the sensor's frame [rad]
    double angleStep = 0.0;   ///< angle between beams [rad], positive; beams * angleStep <= 2 pi
    double minRange = 0.0;    ///< least valid reading [m]
    double maxRange = 8.0;    ///< greatest range [m]
    RangeResolution resolution{.metres = 0.05, .perMetre = 0.01};  ///< resolution of a ray table
    Perception perception = Perception::kRays;
    bool localizes = true;       ///< false: it only serves other features, by an Extractor
    int usedBeams = 0;           ///< about how many beams weigh; 0: all that differ in the table
    double endPointCell = 0.05;  ///< edge of an end-point field's cell [m]
    /// The exponent is that of ray tables: their cells make neighbouring beams err alike.
    SensorModel model{.sigma = 0.05, .sigmaPerMetre = 0.01, .exponent = 0.06};
  };
  /// A good exponent for end-point fields, which do not round the pose.
  static constexpr double kEndPointExponent = 0.3;
  struct Reading {
    double firstAngle = 0.0;    ///< angle of beam 0 in the sensor's frame [rad]
    double angleStep = 0.0;     ///< angle between beams [rad]
    std::vector<float> ranges;  ///< ranges [m]; NaN: not valid; +infinity: nothing within range
  };

  ScanData(SensorId id, const Pose2& mount, const Config& config);
  ~ScanData() override;

  Reading reading() const;
  const Config& config() const { return config_; }
  /// Writes the words of a scan: NaN becomes 0, anything at or beyond @p maxRange (and infinity)
  /// one word above it.
  static void encode(std::span<const float> ranges, double maxRange,
                     std::vector<std::uint32_t>& words);

  /// Makes a feature of this class with the words and parameters of another one that has this
  /// format, whatever its class; null if its format is another one (readingAs()).
  static std::unique_ptr<ScanData> like(const SensorData& feature);
  Format format() const override;
  std::string wordsHelp() const override;
  bool localizes() const override { return config_.localizes; }
  double headingSpacing() const override;
  double positionSpacing() const override;
  /// Returns the range of each beam [m]; the greatest range where nothing is expected in sight. It
  /// is empty with an end-point field, which does not store ranges.
  std::vector<double> expectation(const Pose2& pose) const override;
  bool isAngle(std::size_t) const override { return false; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;
  void store(const WordValue& value, std::span<std::uint32_t> words) const override;
  ExpectationGrain grain() const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  struct Learning;  ///< data that only a sweep needs
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void finishTables() override;
  void useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                 const FieldGrid& grid) override;
  std::shared_ptr<const Weigher> makeWeigher() const override;
  std::shared_ptr<const Weigher> makeRayWeigher() const;
  std::shared_ptr<const Weigher> makeEndPointWeigher() const;
  double rangeOf(std::uint32_t word) const;
  bool marksFrom(const Pose2& sensor) const;
  int runLength(int directions) const;

  Config config_;
  RangeScale scale_;
  std::shared_ptr<DirectionTable> rays_;
  std::shared_ptr<EndPointTables> endPoints_;
  std::shared_ptr<SurfaceField> surfaces_;  ///< surfaces that refine a ray table
  std::vector<float> ranges_;
  std::unique_ptr<Learning> learning_;
};

}  // namespace ortung

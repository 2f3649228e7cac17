#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/LearnedData.hpp"
#include "ortung/tables/RangeScale.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Ranges at evenly spaced bearings, counter-clockwise. Words: one [mm] a beam; 0: no valid
/// measurement; at or above the greatest range: nothing seen.
/// Learns a ray table, which expects the range of each beam [m], or an end-point field, which
/// expects those that its surfaces show; the greatest range where nothing is in sight.
/// Not thread-safe, see SensorData.
class ORTUNG_API ScanData : public LearnedData {
 public:
  static constexpr const char* kFormat = formats::kScan;
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
  /// Returns the settings that a format tells; all others, such as noise, have their defaults.
  /// @throws std::invalid_argument for parameters that are missing or that no such feature has
  static Config configOf(const Format& format, std::span<const std::uint32_t> words = {});

  Reading reading() const;
  /// Returns the ranges of reading().
  std::span<const float> ranges() const { return ranges_; }
  const Config& config() const { return config_; }
  /// Writes the words of a scan: NaN becomes 0, anything at or beyond @p maxRange (and infinity)
  /// one word above it.
  static void encode(std::span<const float> ranges, double maxRange,
                     std::vector<std::uint32_t>& words);

  Format format() const override;
  std::string wordsHelp() const override;
  bool localizes() const override { return config_.localizes; }
  bool isAngle(std::size_t) const override { return false; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;
  void store(const WordValue& value, std::span<std::uint32_t> words) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  double rangeOf(std::uint32_t word) const;

  Config config_;
  std::vector<float> ranges_;
};

}  // namespace ortung

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

/// Distance to the nearest obstacle within a cone. Words: [mm]; at or above the greatest range:
/// nothing seen; 0: not valid. Learns a pose table. Not thread-safe, see SensorData.
class ORTUNG_API ConeData : public LearnedData {
 public:
  static constexpr const char* kFormat = formats::kCone;
  struct Config {
    double openingAngle = 0.35;  ///< whole angle of the cone [rad]
    double maxRange = 3.0;       ///< greatest range [m]
    RangeResolution resolution{.metres = 0.03, .perMetre = 0.02};  ///< resolution of the table
    SensorModel model{.sigma = 0.03, .sigmaPerMetre = 0.02, .outliers = 0.1};
  };
  /// Distance [m]; +infinity: nothing within range; NaN: not valid.
  using Reading = double;

  ConeData(SensorId id, const Pose2& mount, const Config& config);
  ~ConeData() override;
  /// Returns the settings that a format tells; all others, such as noise, have their defaults.
  /// @throws std::invalid_argument for parameters that are missing or that no such feature has
  static Config configOf(const Format& format, std::span<const std::uint32_t> words = {});

  Reading reading() const { return reading_; }
  const Config& config() const { return config_; }
  /// Returns the word of a reading: NaN becomes 0, anything at or beyond @p maxRange a word above
  /// it.
  static std::uint32_t encode(Reading reading, double maxRange);

  Format format() const override;
  std::string wordsHelp() const override;
  bool isAngle(std::size_t) const override { return false; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;
  void store(const WordValue& value, std::span<std::uint32_t> words) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading rangeOf(std::uint32_t word) const;

  Config config_;
  Reading reading_ = 0.0;
};

}  // namespace ortung

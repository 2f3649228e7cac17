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

/// Distance to the nearest obstacle within a cone. Words: [mm]; at or above the greatest range:
/// nothing seen; 0: not valid. Learns a pose table. Not thread-safe, see SensorData.
class ORTUNG_API ConeData : public SensorData {
 public:
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

  Reading reading() const { return reading_; }
  const Config& config() const { return config_; }
  /// Returns the word of a reading: NaN becomes 0, anything at or beyond @p maxRange a word above
  /// it.
  static std::uint32_t encode(Reading reading, double maxRange);

  /// Makes a feature of this class with the words and parameters of another one that has this
  /// format, whatever its class; null if its format is another one (readingAs()).
  static std::unique_ptr<ConeData> like(const SensorData& feature);
  Format format() const override;
  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override { return headingStep_; }
  std::vector<double> expectation(const Pose2& pose) const override;
  bool isAngle(std::size_t) const override { return false; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;
  void store(const WordValue& value, std::span<std::uint32_t> words) const override;
  ExpectationGrain grain() const override { return ExpectationGrain::kCellsAndDirections; }
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
  Reading rangeOf(std::uint32_t word) const;

  Config config_;
  RangeScale scale_;
  std::shared_ptr<DirectionTable> table_;
  double headingStep_ = 0.1;
  Reading reading_ = 0.0;
};

}  // namespace ortung

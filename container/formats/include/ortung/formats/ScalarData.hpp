#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/PositionTable.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// One distance [m], e.g. post3Distance. Words: [mm], or none: looked and saw nothing.
/// Learns a position table. Not thread-safe, see SensorData.
class ORTUNG_API ScalarData : public SensorData {
 public:
  struct Config {
    double maxRange = 20.0;    ///< greatest expectation that is stored [m]
    double fieldOfView = 0.0;  ///< the sensor's whole field of view [rad]; 0 or 2 pi: all around
    SensorModel model{};       ///< noise of the distance [m]
  };
  /// Distance [m]; nothing: the sensor looked and saw nothing.
  using Reading = std::optional<double>;

  ScalarData(SensorId id, const Pose2& mount, const Config& config);
  ~ScalarData() override;

  Reading reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);

  /// Makes a feature of this class with the words and parameters of another one that has this
  /// format, whatever its class; null if its format is another one (readingAs()).
  static std::unique_ptr<ScalarData> like(const SensorData& feature);
  Format format() const override;
  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override;
  std::vector<double> expectation(const Pose2& pose) const override;
  bool isAngle(std::size_t) const override { return false; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                 const FieldGrid& grid) override;
  std::shared_ptr<const Weigher> makeWeigher() const override;

  Config config_;
  std::shared_ptr<const GaussianTable> gaussian_;
  std::shared_ptr<PositionTable> table_;
  Reading reading_;
};

}  // namespace ortung

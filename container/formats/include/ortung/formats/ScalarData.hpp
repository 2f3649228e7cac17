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
    double maxRange = 20.0;    ///< expectations beyond it are not kept [m]
    double fieldOfView = 0.0;  ///< of the sensor [rad]; 0 or 2 pi: all around
    SensorModel model{};
  };
  using Reading = std::optional<double>;

  ScalarData(SensorId id, const Pose2& mount, const Config& config);
  ~ScalarData() override;

  Reading reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);

  /// One with the words of another feature of this format; null if it is of none (readingAs()).
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

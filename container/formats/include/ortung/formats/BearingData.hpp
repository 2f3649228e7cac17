#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/LearnedData.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// One bearing [rad] in the sensor's frame, e.g. post3Bearing. Words: [angle], or none.
/// Learns a bearing table. Not thread-safe, see SensorData.
class ORTUNG_API BearingData : public LearnedData {
 public:
  static constexpr const char* kFormat = formats::kBearing;
  struct Config {
    double fieldOfView = 0.0;  ///< the sensor's whole field of view [rad]; 0 or 2 pi: all around
    SensorModel model{.sigma = 0.02};  ///< noise of the bearing [rad]
  };
  /// Bearing [rad]; nothing: the sensor looked and saw nothing.
  using Reading = std::optional<double>;

  BearingData(SensorId id, const Pose2& mount, const Config& config);
  ~BearingData() override;

  Reading reading() const { return reading_; }
  const Config& config() const { return config_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);

  Format format() const override;
  std::string wordsHelp() const override;
  bool isAngle(std::size_t) const override { return true; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;

  Config config_;
  Reading reading_;
};

}  // namespace ortung

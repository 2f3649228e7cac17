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

/// One distance [m], e.g. post3Distance. Words: [mm], or none: looked and saw nothing.
/// Learns a position table. Not thread-safe, see SensorData.
class ORTUNG_API ScalarData : public LearnedData {
 public:
  static constexpr const char* kFormat = formats::kRange;
  struct Config {
    double maxRange = 20.0;    ///< greatest expectation that is stored [m]
    double fieldOfView = 0.0;  ///< the sensor's whole field of view [rad]; 0 or 2 pi: all around
    SensorModel model{};       ///< noise of the distance [m]
  };
  /// Distance [m]; nothing: the sensor looked and saw nothing.
  using Reading = std::optional<double>;

  ScalarData(SensorId id, const Pose2& mount, const Config& config);
  ~ScalarData() override;
  /// Returns the settings that a format tells; all others, such as noise, have their defaults.
  /// @throws std::invalid_argument for parameters that are missing or that no such feature has
  static Config configOf(const Format& format, std::span<const std::uint32_t> words = {});

  Reading reading() const { return reading_; }
  const Config& config() const { return config_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);

  Format format() const override;
  std::string wordsHelp() const override;
  bool isAngle(std::size_t) const override { return false; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;

  Config config_;
  Reading reading_;
};

}  // namespace ortung

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/LearnedData.hpp"
#include "ortung/formats/SightingBias.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Ranges and bearings of landmarks seen at one moment.
/// Words: three a landmark: identity, [mm], [angle]; none: looked and saw nothing.
/// Learns a position and a bearing table for each landmark of its list or, if they can't be told
/// apart, the position of each: the readings that it learns from have identities, all others need
/// none. A sighting then belongs to the landmark that fits best (UnidentifiedSight.hpp).
/// expectation() is range [m] and bearing [rad] of each landmark of the list, in its order.
/// Not thread-safe, see SensorData.
class ORTUNG_API LandmarksData : public LearnedData {
 public:
  static constexpr const char* kFormat = formats::kLandmarks;
  /// Identity of a sighting whose identity is not known.
  static constexpr std::uint32_t kUnknown = 0xFFFFFFFF;
  struct Config {
    std::vector<std::uint32_t> identities;  ///< identities of the landmarks; not empty, unique
    bool identified = true;                 ///< whether readings tell them apart
    double maxRange = 20.0;                 ///< greatest range [m]
    double fieldOfView = 0.0;               ///< whole field of view [rad]; 0 or 2 pi: all around
    SensorModel range{};
    SensorModel bearing{.sigma = 0.02};
    /// Systematic error of readings, which is corrected before they are weighed.
    SightingBias bias{};
  };
  struct Sighting {
    std::uint32_t identity = 0;
    double range = 0.0;    ///< range along the floor [m]
    double bearing = 0.0;  ///< bearing in the sensor's frame [rad]
  };
  using Reading = std::vector<Sighting>;

  LandmarksData(SensorId id, const Pose2& mount, Config config);
  ~LandmarksData() override;
  /// Returns the settings of a feature with the identities in words of a typical reading.
  static Config configOf(const Format& format, std::span<const std::uint32_t> words);

  const Reading& reading() const { return reading_; }
  /// Returns the words of a reading. @throws std::invalid_argument for numbers that are not finite
  static std::vector<std::uint32_t> encode(const Reading& reading);
  static void encode(const Reading& reading, std::vector<std::uint32_t>& words);
  const Config& config() const { return config_; }
  /// Returns a sighting without the sensor's systematic error.
  Sighting corrected(const Sighting& sighting) const;
  /// Returns the index of an identity in the list; -1: it is not there.
  std::ptrdiff_t indexOf(std::uint32_t identity) const;
  /// Returns the index in the list of identities of a landmark that is sighted from @p pose: by its
  /// identity or, without one, the landmark nearest to the sighting; -1: none.
  std::ptrdiff_t indexOf(const Sighting& sighting, const Pose2& pose) const;

  Format format() const override;
  std::string wordsHelp() const override;
  bool isAngle(std::size_t index) const override { return index % 2 == 1; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;
  void store(const WordValue& value, std::span<std::uint32_t> words) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;

  Config config_;
  Reading reading_;
};

}  // namespace ortung

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/SightingBias.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Ranges and bearings of landmarks seen at one moment.
/// Words: three a landmark: identity, [mm], [angle]; none: looked and saw nothing.
/// Learns a position and a bearing table for each landmark of its list or, if they can't be told
/// apart, the position of each: the readings that it learns from have identities, all others need
/// none. A sighting then belongs to the landmark that fits best (UnidentifiedSight.hpp).
/// Not thread-safe, see SensorData.
class ORTUNG_API LandmarksData : public SensorData {
 public:
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

  const Reading& reading() const { return reading_; }
  /// Returns the words of a reading. @throws std::invalid_argument for numbers that are not finite
  static std::vector<std::uint32_t> encode(const Reading& reading);
  static void encode(const Reading& reading, std::vector<std::uint32_t>& words);
  const Config& config() const { return config_; }
  /// Returns a sighting without the sensor's systematic error.
  Sighting corrected(const Sighting& sighting) const;
  /// Returns the index in the list of identities of a landmark that is sighted from @p pose: by its
  /// identity or, without one, the landmark nearest to the sighting; -1: none.
  std::ptrdiff_t indexOf(const Sighting& sighting, const Pose2& pose) const;

  /// Makes a feature of this class with the words and parameters of another one that has this
  /// format, whatever its class; null if its format is another one (readingAs()).
  static std::unique_ptr<LandmarksData> like(const SensorData& feature);
  Format format() const override;
  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override;
  /// Returns range [m] and bearing [rad] of each landmark of the list, in its order.
  std::vector<double> expectation(const Pose2& pose) const override;
  bool isAngle(std::size_t index) const override { return index % 2 == 1; }
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const override;
  void store(const WordValue& value, std::span<std::uint32_t> words) const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  struct Model;   ///< likelihood of residuals, the same for all readings
  struct Tables;  ///< expectations by landmark, or the places of all landmarks
  class Sight;    ///< the weigher
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void finishTables() override;
  void useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                 const FieldGrid& grid) override;
  std::shared_ptr<const Weigher> makeWeigher() const override;
  std::ptrdiff_t indexOf(std::uint32_t identity) const;

  Config config_;
  std::shared_ptr<const Model> model_;
  std::shared_ptr<Tables> tables_;
  Reading reading_;
};

}  // namespace ortung

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/PoseFixData.hpp"

namespace ortung {

/// A robot or ball at a place in the field frame, as another robot reports it.
struct Place {
  enum class Kind : std::uint8_t { kRobot, kBall };
  static constexpr double kNoHeading = 100.0;  ///< sigma of an unknown heading [rad]

  Kind kind = Kind::kRobot;
  std::string name;      ///< name of what is there: 1 to 64 of [A-Za-z0-9_.-]
  PoseFixData::Fix fix;  ///< pose; with a heading's sigma of kNoHeading, only its position is known
  bool hasHeading() const {
    return headingVariance(fix.covariance) < 0.25 * kNoHeading * kNoHeading;
  }
};

/// Places of robots and balls that others report. They move, so it neither learns nor localizes.
/// Words: of each place 0 for a robot or 1 for a ball, its name as a text (see TalkData), how old
/// it is [us], and the nine words of a fix (see PoseFixData). Not thread-safe, see SensorData.
class ORTUNG_API PlacesData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kPlaces;
  static constexpr std::size_t kMostPlaces = 256;
  /// A place that was reported.
  struct Told {
    Place place;
    double age = 0.0;  ///< age of the report at the time of the reading [s]
    std::string from;  ///< name of the robot that reported it
  };
  using Reading = std::vector<Told>;

  explicit PlacesData(SensorId id);
  ~PlacesData() override;

  const Reading& reading() const { return reading_; }
  /// @throws std::invalid_argument for more places than a reading can hold, and for bad names
  static std::vector<std::uint32_t> encode(const Reading& reading);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading reading_;
};

/// Returns the text by which a robot reports a place to its team: "robot NAME X Y DEG SX SY SDEG
/// CXY CXT CYT", positions and their sigmas in metres, headings in degrees, correlations between -1
/// and 1; DEG and SDEG are
/// "-" where the heading is not known. @throws std::invalid_argument for a bad name, and for
/// numbers that are not finite
ORTUNG_API std::string toText(const Place& place);
/// Returns the place that such a text reports; nothing if the text is of another kind, or wrong.
ORTUNG_API std::optional<Place> placeIn(std::string_view text);

}  // namespace ortung

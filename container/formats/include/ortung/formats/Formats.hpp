#pragma once

/// Formats: the few shapes that most features have. A plugin's data half makes one of them from its
/// parameters. Words are unsigned: millimetres, 1/100 degree, offset where signed.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/tables/DirectionTable.hpp"
#include "ortung/tables/EndPointField.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/tables/PositionTable.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Words of lengths and angles. Encoding rounds to the nearest and clamps to what the word can
/// hold; @pre finite.
namespace words {
inline constexpr std::uint32_t kOffset = 1u << 31;  ///< zero of a signed word
ORTUNG_API std::uint32_t fromMetres(double metres);        ///< unsigned millimetres
ORTUNG_API double toMetres(std::uint32_t word);
ORTUNG_API std::uint32_t fromSignedMetres(double metres);  ///< kOffset + millimetres
ORTUNG_API double toSignedMetres(std::uint32_t word);
ORTUNG_API std::uint32_t fromAngle(double radians);        ///< 1/100 degree + 18000, in [0, 36000)
ORTUNG_API double toAngle(std::uint32_t word);             ///< in [-pi, pi)
ORTUNG_API std::uint32_t fromRate(double radiansPerSecond);  ///< kOffset + 1/100 degree a second
ORTUNG_API double toRate(std::uint32_t word);
inline constexpr std::uint32_t kAngles = 36000;  ///< words of angles are below this
}  // namespace words

/// One distance [m], e.g. post3Distance. Words: [mm], or none: looked and saw nothing.
/// Learns a position table.
class ORTUNG_API ScalarData : public SensorData {
 public:
  struct Config {
    double maxRange = 20.0;      ///< expectations beyond it are not kept [m]
    double fieldOfView = 0.0;    ///< of the sensor [rad]; 0 or 2 pi: all around
    SensorModel model{};
  };
  using Reading = std::optional<double>;

  ScalarData(SensorId id, const Pose2& mount, const Config& config);
  ~ScalarData() override;

  Reading reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);

  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override;
  std::vector<double> expectation(const Pose2& pose) const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  bool isInformative() const override { return reading_.has_value(); }
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void useTables(const TableFile& file, const std::string& prefix, const FieldGrid& grid) override;
  double logProbabilityAt(const Pose2& pose) const override;
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;

  Config config_;
  GaussianTable gaussian_;
  PositionTable table_;
  Reading reading_;
};

/// One bearing [rad] in the sensor's frame, e.g. post3Bearing. Words: [angle], or none.
/// Learns a bearing table.
class ORTUNG_API BearingData : public SensorData {
 public:
  struct Config {
    double fieldOfView = 0.0;  ///< [rad]; 0 or 2 pi: all around
    SensorModel model{.sigma = 0.02};
  };
  using Reading = std::optional<double>;

  BearingData(SensorId id, const Pose2& mount, const Config& config);
  ~BearingData() override;

  Reading reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);

  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override;
  std::vector<double> expectation(const Pose2& pose) const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  bool isInformative() const override { return reading_.has_value(); }
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void useTables(const TableFile& file, const std::string& prefix, const FieldGrid& grid) override;
  double logProbabilityAt(const Pose2& pose) const override;
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;

  Config config_;
  GaussianTable gaussian_;
  BearingTable table_;
  Reading reading_;
};

/// Ranges and bearings of identified landmarks seen at one moment.
/// Words: three a landmark: identity, [mm], [angle]; none: looked and saw nothing.
/// Learns a position and a bearing table for each landmark of its list.
class ORTUNG_API LandmarksData : public SensorData {
 public:
  struct Config {
    std::vector<std::uint32_t> identities;  ///< landmarks that can be told apart; not empty, unique
    double maxRange = 20.0;                 ///< [m]
    double fieldOfView = 0.0;               ///< [rad]; 0 or 2 pi: all around
    SensorModel range{};
    SensorModel bearing{.sigma = 0.02};
  };
  struct Sighting {
    std::uint32_t identity = 0;
    double range = 0.0;    ///< [m]
    double bearing = 0.0;  ///< in the sensor's frame [rad]
  };
  using Reading = std::vector<Sighting>;

  LandmarksData(SensorId id, const Pose2& mount, Config config);
  ~LandmarksData() override;

  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);
  static void encode(const Reading& reading, std::vector<std::uint32_t>& words);
  const Config& config() const { return config_; }

  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override;
  /// Range and bearing of each landmark of the list, in its order.
  std::vector<double> expectation(const Pose2& pose) const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  struct Landmark {
    PositionTable range;
    BearingTable bearing;
  };
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  bool isInformative() const override;
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void useTables(const TableFile& file, const std::string& prefix, const FieldGrid& grid) override;
  double logProbabilityAt(const Pose2& pose) const override;
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;
  std::ptrdiff_t indexOf(std::uint32_t identity) const;

  Config config_;
  GaussianTable rangeGaussian_;
  GaussianTable bearingGaussian_;
  std::vector<Landmark> landmarks_;  ///< in the order of config_.identities
  Reading reading_;
};

/// Ranges at evenly spaced bearings, counter-clockwise. Words: one [mm] a beam; 0: no valid
/// measurement; at or above the greatest range: nothing seen.
/// Learns a ray table or an end-point field.
class ORTUNG_API ScanData : public SensorData {
 public:
  enum class Perception { kRays, kEndPoints };
  struct Config {
    int beams = 180;             ///< 1 to 8192
    double firstAngle = 0.0;     ///< of beam 0 in the sensor's frame [rad]
    double angleStep = 0.0;      ///< between beams [rad], positive; beams * angleStep <= 2 pi
    double minRange = 0.0;       ///< readings below it are not valid [m]
    double maxRange = 8.0;       ///< [m]
    Perception perception = Perception::kRays;
    int usedBeams = 0;           ///< thin to about this many; 0: all that differ in the table
    double endPointCell = 0.05;  ///< edge of an end-point field's cell [m]
    /// The exponent is that of ray tables: their cells make neighbouring beams err alike.
    SensorModel model{.sigma = 0.05, .sigmaPerMetre = 0.01, .exponent = 0.06};
  };
  /// A good exponent for end-point fields, which do not round the pose.
  static constexpr double kEndPointExponent = 0.3;
  struct Reading {
    double firstAngle = 0.0;    ///< [rad]
    double angleStep = 0.0;     ///< [rad]
    std::vector<float> ranges;  ///< [m]; NaN: not valid; +infinity: nothing within range
  };

  ScanData(SensorId id, const Pose2& mount, const Config& config);
  ~ScanData() override;

  Reading reading() const;
  const Config& config() const { return config_; }
  /// NaN becomes 0, anything at or beyond @p maxRange (and infinity) one word above it.
  static void encode(std::span<const float> ranges, double maxRange,
                     std::vector<std::uint32_t>& words);

  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override;
  /// Range of each beam [m]; the greatest range where nothing is expected to be seen.
  /// With an end-point field: empty, since that does not keep ranges.
  std::vector<double> expectation(const Pose2& pose) const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  struct Prepared;  ///< the reading in the table's terms: levels, caps, end points
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  bool isInformative() const override;
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void finishTables() override;
  void useTables(const TableFile& file, const std::string& prefix, const FieldGrid& grid) override;
  double logProbabilityAt(const Pose2& pose) const override;
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;
  void prepare();
  void prepareRays();
  void prepareEndPoints();
  void weighRays(const SampleView& poses, std::span<float> logProbability) const;
  void weighEndPoints(const SampleView& poses, std::span<float> logProbability) const;
  int runLength(int directions) const;

  Config config_;
  RangeScale scale_;
  FieldGrid grid_;  ///< of the tables
  DirectionTable rays_;
  EndPointField endPoints_;
  std::vector<float> ranges_;
  std::unique_ptr<Prepared> prepared_;
};

/// Distance to the nearest obstacle within a cone. Words: [mm]; at or above the greatest range:
/// nothing seen; 0: not valid. Learns a pose table.
class ORTUNG_API ConeData : public SensorData {
 public:
  struct Config {
    double openingAngle = 0.35;  ///< whole angle [rad]
    double maxRange = 3.0;       ///< [m]
    SensorModel model{.sigma = 0.03, .sigmaPerMetre = 0.02, .outliers = 0.1};
  };
  /// [m]; +infinity: nothing within range; NaN: not valid
  using Reading = double;

  ConeData(SensorId id, const Pose2& mount, const Config& config);
  ~ConeData() override;

  Reading reading() const { return reading_; }
  const Config& config() const { return config_; }
  static std::uint32_t encode(Reading reading, double maxRange);

  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override { return headingStep_; }
  std::vector<double> expectation(const Pose2& pose) const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  bool isInformative() const override;
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void finishTables() override;
  void useTables(const TableFile& file, const std::string& prefix, const FieldGrid& grid) override;
  double logProbabilityAt(const Pose2& pose) const override;
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;
  void prepare();
  float logProbabilityOf(std::uint8_t level) const;

  Config config_;
  RangeScale scale_;
  DirectionTable table_;
  double headingStep_ = 0.1;
  Reading reading_ = 0.0;
  std::vector<float> logByLevel_;  ///< ln p of the present reading by expected level
};

/// Pose in the odometry frame and velocities (paper, section 4). Words: x, y [signed mm],
/// [angle], translational velocity [signed mm/s], rotational velocity [signed 1/100 degree/s],
/// then up to 16 of the motion plugin's own.
class ORTUNG_API OdometryData : public SensorData {
 public:
  struct Reading {
    Pose2 pose;                         ///< in the odometry frame
    double translationalVelocity = 0.0; ///< along the robot's x axis [m/s]
    double rotationalVelocity = 0.0;    ///< [rad/s]
    std::vector<std::uint32_t> motionData;
  };
  explicit OdometryData(SensorId id);
  ~OdometryData() override;
  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);
  static void encode(const Reading& reading, std::vector<std::uint32_t>& words);
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading reading_;
};

/// A pose in the field frame, e.g. ground truth (type "groundTruth"). Words: x, y [signed mm],
/// [angle].
class ORTUNG_API PoseData : public SensorData {
 public:
  using Reading = Pose2;
  explicit PoseData(SensorId id);
  ~PoseData() override;
  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Pose2& pose);
  static void encode(const Pose2& pose, std::vector<std::uint32_t>& words);
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Pose2 reading_;
};

}  // namespace ortung

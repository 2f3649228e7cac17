#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/SampleView.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/container/Abi.hpp"
#include "ortung/core/Format.hpp"
#include "ortung/core/ReadingValue.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// The three names by which a feature is found (paper, section 3).
/// Each is of [A-Za-z0-9_.-], 1 to 64 characters.
struct SensorId {
  std::string model;    ///< device, e.g. "LMS200"
  std::string type;     ///< kind of sensor, e.g. "LRF"
  std::string feature;  ///< what it measures, e.g. "180DegreeScan"

  bool operator==(const SensorId&) const = default;
};

/// "LMS200/LRF/180DegreeScan".
ORTUNG_API std::string toText(const SensorId& id);

/// Reads the text form. @throws std::invalid_argument saying what is wrong with it.
ORTUNG_API SensorId parseSensorId(std::string_view text);

/// The newest reading of one feature, and what the feature is expected to read at every pose.
///
/// The reading is kept as the words of getData(): the same on the wire, in a record and in memory,
/// so it makes no difference where it came from. A plugin derives from this class or, in most
/// cases, from one of the formats (ScalarData, ScanData, ...). Not thread-safe; the container
/// locks. Several threads may call const functions at a time.
class ORTUNG_API SensorData {
 public:
  static constexpr const char* kInterface = "ortung.SensorData/" ORTUNG_CONTAINER_ABI;

  /// @param mount pose of the sensor in the robot frame
  /// @throws std::invalid_argument for a bad name or a mount that is not finite
  explicit SensorData(SensorId id, const Pose2& mount = {});
  virtual ~SensorData();
  SensorData(const SensorData&) = delete;
  SensorData& operator=(const SensorData&) = delete;

  const SensorId& id() const { return id_; }
  const Pose2& mount() const { return mount_; }

  // --- the reading ---
  /// Takes a reading (paper, section 4). If the words are refused, the old reading stays.
  /// @throws std::invalid_argument naming the feature, what was found and what was expected
  void setData(Timestamp stamp, std::span<const std::uint32_t> words);
  /// Throws what setData() would throw, and takes nothing.
  void checkData(std::span<const std::uint32_t> words) const;
  std::span<const std::uint32_t> getData() const { return words_; }
  Timestamp stamp() const { return stamp_; }
  /// Returns how many readings were taken; 0: none yet.
  std::uint64_t sequence() const { return sequence_; }
  /// Returns the format of the words, for programs (formats/FormatNames.hpp). It never changes, and
  /// has all parameters that are needed to understand the words.
  virtual Format format() const = 0;
  /// Returns a line for people about what the words mean: `ortung check`, the protocol's
  /// description.
  virtual std::string wordsHelp() const = 0;

  // --- the perceptual model ---
  /// Returns whether the feature can weigh poses once it has learned.
  virtual bool localizes() const { return false; }
  /// Returns whether learning has ended or tables were loaded.
  bool isLearned() const { return learned_; }

  /// Starts a sweep over the open cells of @p region.
  /// @param headingStep resolution of tables that depend on direction [rad]
  void beginLearning(const FieldRegion& region, double headingStep);
  /// Returns the widest step between the sweep's headings that misses nothing [rad]; 2 pi: one
  /// heading is enough.
  virtual double headingSpacing() const;
  /// Returns the widest step between the sweep's positions that misses nothing [m]; 0: every cell
  /// is needed.
  virtual double positionSpacing() const { return 0.0; }
  /// Takes the present noise-free reading as the expectation with the robot at @p pose
  /// (paper, section 5.2). The sweep puts the SENSOR, pose * mount(), on the centres of cells.
  /// @pre beginLearning() came before
  void learnProbability(const Pose2& pose);
  void endLearning();

  /// Returns the weigher of the present reading, which the next reading does not change. It is null
  /// before learning, without a reading, and for a reading that says nothing about the pose (e.g.
  /// no valid beam). It is made on the first call.
  std::shared_ptr<const Weigher> weigher() const;
  /// Returns p(s|l) of the present reading, see Weigher; kNoExpectation if it has none.
  double getProbability(const Pose2& pose) const;
  /// Weighs a sample set by the present reading, see Weigher; nothing is added if it has none.
  /// @pre poses.size() == logProbability.size()
  void getProbability(const SampleView& poses, std::span<float> logProbability) const;
  /// Returns whether the present reading says anything about the pose.
  bool canWeigh() const { return weigher() != nullptr; }

  /// Returns what the feature should read at @p pose: metres and radians in the format's order,
  /// NaN where nothing is expected; empty where there is no expectation at all.
  virtual std::vector<double> expectation(const Pose2& pose) const;

  // --- values of readings, whatever the format; from the parameter `row` unless overridden ---
  /// Returns whether a value of expectation() is an angle [rad]; else it is a length [m].
  virtual bool isAngle(std::size_t index) const;
  /// Returns the present reading in the order of expectation(), to be compared with it. It depends
  /// on
  /// @p pose where readings do not say what was seen. NaN: not measured, or nothing to compare
  /// with; infinite: beyond the sensor's range; empty if the format has no such values.
  virtual std::vector<double> measured(const Pose2& pose) const;
  /// Returns the covariance of measured() that the reading itself gives, row-major; empty if
  /// readings have none.
  virtual std::vector<double> covariance(const Pose2& pose) const;
  /// Returns how finely expectation() resolves poses.
  virtual ExpectationGrain grain() const { return ExpectationGrain::kCells; }
  /// Returns the values in words that checkData() accepts, entry by entry: those that can be read
  /// and changed without knowing the format.
  virtual std::vector<WordValue> valuesIn(std::span<const std::uint32_t> words) const;
  /// Writes a changed value of valuesIn() back into the words.
  virtual void store(const WordValue& value, std::span<std::uint32_t> words) const;

  /// Returns all settings that shape the expectation tables ("beams=180 fov_deg=180 ..."), so that
  /// a table of another sensor is recognised. Noise is not among them: tables do not depend on it.
  virtual std::string learningKey() const;
  /// Writes the tables, each array's name beginning with @p prefix.
  virtual void saveTables(TableWriter& file, const std::string& prefix) const;
  /// Uses the tables of a file, without copying. @throws TableError
  void loadTables(std::shared_ptr<const TableFile> file, const std::string& prefix,
                  const FieldGrid& grid);

 private:
  /// @throws std::invalid_argument saying what was found in the words and what was expected
  virtual void check(std::span<const std::uint32_t> words) const = 0;
  /// Makes the reading from words that check() has accepted.
  virtual void decode(std::span<const std::uint32_t> words) = 0;
  virtual void startTables(const FieldRegion& region, double headingStep);
  virtual void learn(const Pose2& robotInField);
  virtual void finishTables();
  /// Uses the arrays of a file; the tables share ownership of the file that their spans point into.
  virtual void useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                         const FieldGrid& grid);
  /// Makes the weigher of the present reading; null if that says nothing about the pose. What it
  /// shares with this feature (tables) must not change any more.
  virtual std::shared_ptr<const Weigher> makeWeigher() const;
  void forgetWeigher();

  SensorId id_;
  Pose2 mount_;
  std::vector<std::uint32_t> words_;
  Timestamp stamp_ = 0;
  std::uint64_t sequence_ = 0;
  bool learned_ = false;
  mutable std::mutex weigherMutex_;  ///< guards the two members below, which readers make
  mutable std::shared_ptr<const Weigher> weigher_;
  mutable bool isWeigherMade_ = false;
};

}  // namespace ortung

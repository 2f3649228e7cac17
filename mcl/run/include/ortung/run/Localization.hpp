#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/mcl/GridFilter.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung {

/// Where the belief starts.
struct LocalizationStart {
  enum class Kind : std::uint8_t {
    kGlobal,  ///< anywhere: the first readings find the place
    kTruth,   ///< the first ground truth of the source (without one: in the container)
    kPose     ///< the pose `pose`
  };
  Kind kind = Kind::kGlobal;
  Pose2 pose = {};  ///< pose of kPose, field frame
  /// Standard deviation of positions with kTruth and kPose [m], at least 0.
  double sigmaPosition = 0.3;
  /// Standard deviation of headings with kTruth and kPose [rad], at least 0.
  double sigmaHeading = 0.1745;
};

/// The filter that estimates where the robot is.
enum class LocalizationFilter : std::uint8_t {
  kMcl,
  kGrid,          ///< an exhaustive reference for small fields (GridFilter)
  kMclBesideGrid  ///< MCL; the grid filter follows the same readings, to compare with
};

/// What a localization works with; only robot and tables have no default.
struct LocalizationConfig {
  std::filesystem::path robot = {};   ///< robot file
  std::filesystem::path tables = {};  ///< table file of `ortung learn` for this robot and world
  std::string source = {};            ///< "KIND:PATH?key=value"; "": the program sets readings
  std::uint64_t seed = 1;             ///< seed of all random numbers
  /// Greatest number of samples; none: the robot file's.
  std::optional<std::size_t> particles = {};
  std::optional<unsigned> threads = {};  ///< threads of MCL; the result does not depend on them
  LocalizationStart start = {};
  std::optional<Parameters> motion = {};  ///< settings in place of the robot file's [motion]
  bool anyWorld = false;  ///< whether readings may be of another world than the tables
  LocalizationFilter filter = LocalizationFilter::kMcl;
  GridConfig grid = {};  ///< settings of the grid filter, if there is one
  /// Adds the features mcl/LOCALIZATION/pose (words as of PoseFixData), status (TrackData), places
  /// (ClustersData), map (ChangesData), work (WorkData) and samples (SamplesData, see
  /// wantSamples()) to the container and sets them to each new estimate, so that they can be read,
  /// recorded and served. Status is also set when it or its reason changes between two estimates,
  /// at the time of the newest odometry, e.g. since readings stopped. Only with MCL.
  bool publish = false;
  /// Makes each update end within `budget_ms` by the clock (Mcl::keepTime), for robots that run
  /// now. Otherwise times are nominal, and the same readings give the same bits. Only of MCL.
  bool keepsTime = false;
};

/// Adds the features that `publish` adds to another container, e.g. one that is served.
ORTUNG_API void addPublishedFeatures(SensorContainer& container);

/// Thrown if readings come from another world than the one that the tables were learned in.
class ORTUNG_API WorldMismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~WorldMismatch() override;
};

/// Localizes one robot: owns its features, their tables, MCL and, if there is one, the source.
///
/// With a source, next() pulls readings until there is a new estimate. Without, the program sets
/// its readings with container().set() and calls update() when it wants an estimate.
///
/// Any number of threads may set and read readings of container(), while one thread, the same or
/// another, calls update(); all other members are for that one thread.
class ORTUNG_API Localization {
 public:
  /// Opens the robot file, the tables and the source that @p config names.
  /// @throws ConfigError, PluginError, TableError, SourceTextError, WorldMismatch,
  ///   std::invalid_argument for settings out of their range, std::runtime_error of the source
  explicit Localization(const LocalizationConfig& config);
  /// Works on an opened robot with tables, and an opened source or null. The paths and the source's
  /// text in @p config are only used in error messages.
  /// @throws like the constructor that opens them itself
  Localization(std::unique_ptr<Robot> robot, std::unique_ptr<Source> source,
               const LocalizationConfig& config);
  ~Localization();
  Localization(const Localization&) = delete;
  Localization& operator=(const Localization&) = delete;

  /// Pulls moments from the source until the belief was weighed. Returns the new estimate, or
  /// nothing at the end of the source or when @p goOn, called before each moment, returns false.
  /// @throws std::runtime_error of the source; at the end, too, if the start waits for a ground
  ///   truth that never came
  std::optional<PoseEstimate> next(const std::function<bool()>& goOn = {});

  /// Fills in the next moment of the source; returns false at the end. With update() it does what
  /// next() does, step by step.
  /// @throws std::runtime_error of the source, std::logic_error without one
  bool advance();
  /// Fills in a moment that the program has, in place of a source: with update() it does what
  /// next() does. Moments come in the order of time. @param moment readings of one stamp, at least
  /// one
  /// @throws std::invalid_argument for words that a feature refuses
  void take(std::span<const Message> moment);
  /// Takes the container's new readings. Returns the new estimate if they weighed the belief.
  std::optional<PoseEstimate> update();

  /// Takes odometry only, which estimate(stamp) then includes.
  void followOdometry();
  /// Returns the estimate at @p stamp: the belief carried on by odometry, as Mcl::estimate(stamp);
  /// nothing before there is a belief. mcl().estimate() is that of the newest weighing.
  std::optional<PoseEstimate> estimate(Timestamp stamp) const;

  /// Begins anew; the container's present readings count again.
  /// @throws std::invalid_argument for negative sigmas, and for a pose at which the robot can't
  ///   stand, nor within three sigmas of it, such as one off the map. With kTruth, update() throws
  ///   that once the truth is known
  void start(const LocalizationStart& start);
  // The functions that follow need MCL: with a grid filter in its place they throw
  // std::logic_error.

  /// Sets the belief to a pose that the caller knows now; odometry carries it on and readings
  /// sharpen it. Unlike start() it keeps what is known of time and odometry, and does not wait for
  /// a reading: once there is odometry, it is published at once.
  /// @param covariance may be singular
  /// @throws std::invalid_argument if that is no covariance, or as start(). The belief stays then
  void setPose(const Pose2& pose, const PoseCovariance& covariance);
  /// Forgets the place: the present readings, or else the next ones, find it anew. Odometry goes on
  /// meanwhile.
  void relocalize();

  /// Switches the published samples on, which are set only while a client reads them. Thread-safe.
  void wantSamples(bool wanted) { wantsSamples_ = wanted; }
  /// Checks a pose as start() and setPose() do. Thread-safe.
  /// @param sigmaPosition [m] @throws std::invalid_argument as they do
  void checkPose(const Pose2& pose, double sigmaPosition) const;

  /// Writes the belief, moved to the newest odometry, into a file that appears whole or not at all.
  /// @throws std::logic_error before there is a belief, TableError if it can't be written
  void saveBelief(const std::filesystem::path& file) const;
  /// Restores the belief that an earlier run in this world has saved; odometry may begin anew. The
  /// robot may have been pushed meanwhile, so each sample is moved by a random amount. If it was
  /// carried farther away, readings will show it.
  /// @param sigmaPosition, sigmaHeading standard deviations of that motion [m], [rad]; 0: none
  /// @throws TableError saying why the file is refused, std::invalid_argument for sigmas that are
  ///   no numbers >= 0. The belief stays then
  void restoreBelief(const std::filesystem::path& file, double sigmaPosition = 0.1,
                     double sigmaHeading = 0.0873);

  /// Returns false while the start waits for ground truth.
  bool isStarted() const { return !waitsForTruth_; }

  SensorContainer& container() { return robot_->container; }
  const Robot& robot() const { return *robot_; }
  const Mcl& mcl() const { return *mcl_; }  ///< has no belief if a grid filter is in its place
  const GridFilter* grid() const { return grid_.get(); }  ///< null without a grid filter
  bool hasOdometry() const { return isGrid() ? grid_->hasOdometry() : mcl_->hasOdometry(); }
  const MclConfig& mclConfig() const { return mclConfig_; }

  Source& source();  ///< @throws std::logic_error without one
  Feeder& feeder();  ///< @throws std::logic_error without a source
  /// Returns how the source's world differs from that of the tables, if `anyWorld` permitted it;
  /// else
  /// "".
  const std::string& worldMismatch() const { return worldMismatch_; }
  /// Return the computing time of the updates which led to the newest estimate: that of the longest
  /// one, and that of all [ms].
  double updateMilliseconds() const { return longest_; }
  double spentMilliseconds() const { return spent_; }

 private:
  struct Opened {
    std::unique_ptr<Robot> robot;
    std::unique_ptr<Source> source;
  };
  static Opened open(const LocalizationConfig& config);
  Localization(Opened opened, const LocalizationConfig& config);
  void checkWorld(const LocalizationConfig& config);
  void startAt(const Pose2& pose);
  void searchMeanwhile(Timestamp since, Timestamp until);
  void count(double milliseconds);
  PoseEstimate present() const;
  void publish(const PoseEstimate& estimate);
  void publishChange();
  std::optional<Message> newChanges(Timestamp stamp);
  std::optional<Pose2> truth() const;
  bool isGrid() const { return filter_ == LocalizationFilter::kGrid; }
  void requireMcl(const char* what) const;

  std::string sourceName_;
  std::unique_ptr<Robot> robot_;
  std::unique_ptr<Source> source_;
  std::unique_ptr<Feeder> feeder_;  ///< null without a source
  MclConfig mclConfig_;
  LocalizationFilter filter_;
  std::unique_ptr<Mcl> mcl_;
  std::unique_ptr<GridFilter> grid_;
  LocalizationStart start_;
  bool waitsForTruth_ = false;
  bool publishes_ = false;
  std::atomic<bool> wantsSamples_ = false;
  std::uint64_t estimates_ = 0;
  std::optional<Timestamp> taken_;        ///< stamp of the newest moment that the program has given
  const SensorData* odometry_ = nullptr;  ///< odometry's feature; null without odometry
  std::optional<std::pair<TrackStatus, TrackReason>> published_;
  std::optional<Timestamp> toldAt_;  ///< the pose that was set last was published with this stamp
  std::optional<Timestamp> lookedAtMap_;  ///< when the map's changes were asked for last
  Timestamp toldMapAt_ = 0;               ///< time of their newest reading
  std::vector<std::uint32_t> toldMap_;    ///< its words
  std::string worldMismatch_;
  std::optional<Timestamp> knownSince_;  ///< a search ended then, between two moments
  double newest_ = 0.0;                  ///< computing time of the newest update [ms]
  double longest_ = 0.0;
  double spent_ = 0.0;
  // Since the newest estimate.
  double longestSince_ = 0.0;
  double spentSince_ = 0.0;
};

}  // namespace ortung

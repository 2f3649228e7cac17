#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "Choice.hpp"
#include "FieldCover.hpp"
#include "IsOver.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

class Workers;

/// Finds the most probable poses of one time step's readings among all positions where the robot
/// can stand, in all headings. A coarse grid of poses is weighed by blurred readings
/// (BlurrableWeigher); the best ones are divided repeatedly, until the readings themselves can
/// distinguish their parts; and the best of those, from distinct places, climb to their local
/// maxima. It uses no random numbers.
///
/// It may be spread over several updates: begin(), then work() until it is done. The result does
/// not depend on how much is done in each call. It shares ownership of the readings' weighers, so
/// the result is for the time of those readings, however long ago that is once the search is done.
/// Not thread-safe.
class ORTUNG_API FieldSearch {
 public:
  struct Settings {
    /// Spacing of the coarse grid's positions [m]; rounded to cells.
    double spacing = FieldCover::kSpacing;
    int headings = 32;             ///< headings of the coarse grid per turn, at least 1
    std::size_t survivors = 2000;  ///< most poses that are divided, at least 1
    std::size_t places = 50;       ///< greatest number of places that are found, at least 1
    double apartMetres = 0.5;      ///< least distance between two places [m]
    double apartRadians = 0.35;    ///< least difference of headings [rad]: either makes two places
    Workers* workers = nullptr;    ///< borrowed; the result does not depend on them
    /// The coarse grid's positions, if they are known already; then they say their spacing.
    std::shared_ptr<const FieldCover> cover = {};
    /// Checks the settings. @throws std::invalid_argument for values that make no sense
    void check() const;
  };
  struct Place {
    Pose2 pose;
    double logProbability;  ///< ln p(s|l) of the readings, not blurred, in [-10,000, 10,000]
  };

  /// @param region borrowed; if the robot can stand nowhere in it, nothing is found
  FieldSearch(const FieldRegion& region, const Settings& settings);

  /// Begins a new search, and forgets the results of the last one.
  /// @param readings readings of one time step; without any, the search is done and has found
  ///   nothing
  void begin(std::vector<std::shared_ptr<const Weigher>> readings);
  /// Weighs poses until they have taken this long [ms] by the weighers' nominal times; at least one
  /// pose. No clock is read, so a replay does the same in each call. @returns isDone()
  /// @param isOver ends the work earlier; asked after each few poses, and while some are chosen
  bool work(double nominalMilliseconds, const IsOver& isOver = {});
  bool isDone() const { return stage_ == Stage::kDone; }
  /// Returns the greatest nominal time of a whole search by these readings [ms]; 0 before the first
  /// begin().
  double nominalMilliseconds() const;
  /// Returns the nominal time of the work done since begin() [ms].
  double workedMilliseconds() const { return 1e-6 * worked_; }
  /// Returns the places found, once the search is done: best first, no two nearer than the settings
  /// say. A peak that is wider than that gives several places, so with a vague reading all may be
  /// of one peak.
  std::span<const Place> places() const { return places_; }

 private:
  enum class Stage : std::uint8_t { kCover, kDivide, kClimb, kDone };
  /// The readings, blurred for one stage of the search.
  struct Readings {
    std::vector<std::shared_ptr<const Weigher>> weighers;
    double nanoseconds = 0.0;  ///< time per pose [ns]
  };
  struct Candidate {
    Pose2 pose;
    float logProbability = 0.0F;
    std::size_t number = 0;  ///< number in its stage, which orders candidates of equal probability
    bool isBetterThan(const Candidate& other) const {
      return logProbability != other.logProbability ? logProbability > other.logProbability
                                                    : number < other.number;
    }
  };

  Readings blurredBy(const PoseResolution& spread) const;
  std::size_t posesInStage() const;
  Pose2 poseAt(std::size_t number) const;
  bool isStandable(const Pose2& pose) const;
  void weighNext(double& nanoseconds, const IsOver& isOver);
  void weigh(std::size_t count);
  void keep(const Candidate& weighed);
  std::size_t crowd() const;
  void prune();
  bool endStage(const IsOver& isOver);
  void beginChoice();
  bool chooseSome();
  bool isWantedOfPlace(const Candidate& one);
  void divide();
  void beginClimb();
  bool climbOn();
  void finish();

  const FieldRegion& region_;
  Settings settings_;
  std::shared_ptr<const FieldCover> cover_;
  Readings sharp_;
  Stage stage_ = Stage::kDone;
  Readings present_;                 ///< readings as the present stage weighs them
  double spacing_ = 0.0;             ///< spacing of the stage's positions [m]
  double turn_ = 0.0;                ///< [rad]
  double nanosecondsOfCover_ = 0.0;  ///< time per pose [ns]
  double worked_ = 0.0;              ///< nominal time worked [ns]
  int climbs_ = 0;
  std::vector<Candidate> parents_;  ///< parents of the stage's poses; none in the first stage
  std::size_t next_ = 0;            ///< number of the pose to weigh next
  SampleSet batch_;                 ///< poses weighed last; `logWeight` is ln p
  std::vector<Candidate> kept_;     ///< the best of this stage so far, and some more; unordered
  bool isPruned_ = false;  ///< whether kept_ was pruned: then its last one is the worst to be kept
  /// Choice of those that are treated further, once all poses of the stage are weighed.
  std::optional<Choice<Candidate>> choice_;
  std::map<std::array<long, 3>, std::size_t> countOfPlace_;  ///< survivors chosen of each place
  std::vector<Place> places_;
};

}  // namespace ortung

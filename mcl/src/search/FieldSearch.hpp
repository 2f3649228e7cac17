#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

class Workers;

/// The best poses of one moment's readings out of all where the robot can stand, in all headings. A
/// cover of the floor is weighed by blurred readings (BlurrableWeigher); the best of it are divided
/// again and again, until the readings themselves tell their parts from each other; and the best of
/// those, each of another place, climb to the top of their hills. No random numbers.
///
/// A job that may be spread over time: begin(), then work() until it is done. What is found does
/// not depend on how much is done at a time. It has a share in the readings' weighers, so it speaks
/// of their moment, however long ago that is once it is done. Not thread-safe.
class ORTUNG_API FieldSearch {
 public:
  struct Settings {
    double spacing = 0.3;          ///< spacing of the cover's positions [m]; rounded to cells
    int headings = 32;             ///< headings of the cover per turn, at least 1
    std::size_t survivors = 2000;  ///< most poses that are divided, at least 1
    std::size_t places = 50;       ///< most that are found, at least 1
    double apartMetres = 0.5;      ///< least distance between two places [m]
    double apartRadians = 0.35;    ///< least difference of headings [rad]: either is enough
    Workers* workers = nullptr;    ///< borrowed; what is found does not depend on them
    /// @throws std::invalid_argument for what makes no sense
    void check() const;
  };
  struct Place {
    Pose2 pose;
    double logProbability;  ///< ln p(s|l) of the readings as they are, in [-10,000, 10,000]
  };

  /// @param region borrowed; it may have nowhere to stand, then nothing is found
  FieldSearch(const FieldRegion& region, const Settings& settings);

  /// Begins anew, and forgets what was found.
  /// @param readings of one moment; without any, it is done and has found nothing
  void begin(std::vector<std::shared_ptr<const Weigher>> readings);
  /// Weighs poses until they have taken so long by the weighers' nominal times; one at least. No
  /// clock is asked: a replay does the same in each call. @returns isDone()
  bool work(double nominalMilliseconds);
  bool isDone() const { return stage_ == Stage::kDone; }
  /// What whole searches take by these readings, at most [ms]; 0 before the first begin().
  double nominalMilliseconds() const;
  /// What was done of it since begin(), by nominal times [ms].
  double workedMilliseconds() const { return 1e-6 * worked_; }
  /// Once it is done: best first, no two nearer than the settings say. A hill that is wider than
  /// that is several places, so with a vague reading they may all be of one.
  std::span<const Place> places() const { return places_; }

 private:
  enum class Stage : std::uint8_t { kCover, kDivide, kClimb, kDone };
  /// Readings as a stage weighs them.
  struct Readings {
    std::vector<std::shared_ptr<const Weigher>> weighers;
    double nanoseconds = 0.0;  ///< a pose
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

  void makeCover();
  Readings blurredBy(const PoseResolution& spread) const;
  std::size_t posesInStage() const;
  Pose2 poseAt(std::size_t number) const;
  bool isStandable(const Pose2& pose) const;
  void weigh(std::size_t count);
  void keep(const Candidate& weighed);
  std::size_t crowd() const;
  void prune();
  std::vector<Candidate> survivors();
  void endStage();
  void divide();
  void beginClimb();
  void climbOn();
  std::vector<Candidate> apart(std::size_t most, double metres, double radians);
  void finish();

  const FieldRegion& region_;
  Settings settings_;
  double spacingOfCover_ = 0.0;       ///< [m]
  std::vector<std::uint32_t> cover_;  ///< cells
  Readings sharp_;
  Stage stage_ = Stage::kDone;
  Readings present_;                 ///< readings as the present stage weighs them
  double spacing_ = 0.0;             ///< spacing of the stage's poses [m]
  double turn_ = 0.0;                ///< [rad]
  double nanosecondsOfCover_ = 0.0;  ///< a pose
  double worked_ = 0.0;              ///< [ns]
  int climbs_ = 0;
  std::vector<Candidate> parents_;  ///< parents of the stage's poses; none while it is the cover
  std::size_t next_ = 0;            ///< number of the pose that comes next
  SampleSet batch_;                 ///< weighed last; `logWeight` is ln p
  std::vector<Candidate> kept_;     ///< the best of this stage so far, unordered, and some more
  bool isPruned_ = false;  ///< whether kept_ was pruned: its last one is then the worst that counts
  std::vector<Place> places_;
};

}  // namespace ortung

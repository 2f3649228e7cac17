#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "Biases.hpp"
#include "Confidence.hpp"
#include "Confirmation.hpp"
#include "Drift.hpp"
#include "GlobalStart.hpp"
#include "Hypothesis.hpp"
#include "Intake.hpp"
#include "Kld.hpp"
#include "Lateness.hpp"
#include "Momentum.hpp"
#include "OdometryTrust.hpp"
#include "Polish.hpp"
#include "PoseSearch.hpp"
#include "Recovery.hpp"
#include "Resampling.hpp"
#include "Rivals.hpp"
#include "UpdateTime.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Workers.hpp"
#include "ortung/mcl/Mcl.hpp"

namespace ortung {

/// Streams of random numbers: one a purpose and step.
enum class Purpose : std::uint64_t { kMotion, kResampling, kStart, kRivals, kSpread, kCount };

/// Where nobody knows how the robot moved there are so many samples at least, if the set may be so
/// large.
inline constexpr std::size_t kSpreadSamples = 4000;

/// What was read so shortly ago is of the present place [us].
inline constexpr Timestamp kPresent = 500'000;

/// The filter in three parts: what is asked of it (Mcl.cpp), how the samples move
/// (MclPrediction.cpp), and how readings weigh them (MclCorrection.cpp).
struct Mcl::Impl {
  MclConfig config;
  FieldRegion region;
  std::unique_ptr<MotionModel> motion;
  PoseSearch search;
  UpdateTime time;
  mutable Workers workers;
  Hypothesis belief;
  PoseEstimate estimate;    ///< of the newest weighing
  PoseResolution coarsest;  ///< of the tables that it was weighed by
  /// Of the samples as they are now; made when it is asked for.
  mutable std::optional<PoseEstimate> present;
  Intake intake;
  std::optional<Pose2> lastOdometry;
  std::optional<Timestamp> lastTime;  ///< up to which the samples were moved to weigh them
  double usualInterval = 0.0;         ///< between weighings, lately at most [s]
  OdometryTrust trust;
  Polish polish;
  Biases biases;
  Lateness lateness;
  Momentum momentum;        ///< where isBlind
  SampleSet anchor;         ///< the belief when it was weighed last, while odometry is not trusted
  std::size_t drifted = 0;  ///< of the samples, from this one on they drifted; 0: none
  bool isBlind = true;      ///< nobody tells how the robot moved up to this reading
  std::uint64_t step = 0;
  Recovery recovery;
  Rivals rivals;
  double way = 0.0;           ///< since the last weighing [m]; a turn of 1 rad counts as 1 m
  double metres = 0.0;        ///< the same without turns
  bool waitsForStart = true;  ///< a global start waits for the first reading, or searches
  GlobalStart globalStart;
  Confirmation confirmation;  ///< of where that has found the robot
  bool hasStarted = false;    ///< there is an estimate that no update() has told of yet

  Impl(const MclConfig& c, FieldRegion r, std::unique_ptr<MotionModel> m)
      : config((c.check(), c)),
        region((r.check(), std::move(r))),
        motion(std::move(m)),
        search(region),
        time(config),
        workers(config.threads),
        intake(config, *motion),
        lateness(config, *motion),
        momentum(config),
        recovery(config),
        rivals(config, region, search, *motion, time, workers),
        globalStart(config, region, search, workers) {}

  std::uint64_t stream(Purpose purpose) const {
    return step * static_cast<std::uint64_t>(Purpose::kCount) + static_cast<std::uint64_t>(purpose);
  }

  NewsByTime look(const SensorContainer& container);
  void forgetTimes() {
    lastOdometry.reset();
    lastTime.reset();
  }
  void begin(bool waits) {
    beginHere(waits);
    intake.forget();
    lateness.forget();
    forgetTimes();
  }
  /// Another belief; time and odometry go on.
  void beginHere(bool waits) {
    waitsForStart = waits;
    hasStarted = false;
    globalStart.forget();
    if (waits) waitAnywhere();
    confirmation.forget();
    recovery.forget();
    rivals.forget();
    trust.forget();
    polish.forget();
    biases.forget();
    lateness.forgetBelief();
    momentum.forget();
    coarsest = {};
    present.reset();
    intake.countAgain(estimate.stamp - kPresent);
  }
  std::optional<Timestamp> newestTime() const;
  /// Time in which nobody told how the robot moved [s].
  double secondsSinceWeighing(Timestamp stamp) const {
    return lastTime ? driftSeconds(*lastTime, stamp) : 0.0;
  }
  /// Of the samples, and their bins, which whoever resamples them needs again.
  PoseEstimate estimateBy(const std::vector<double>& weights, std::optional<PoseBins>& bins) {
    bins.emplace(config, belief.samples().view(), &workers);
    return estimateOf(*bins, belief.samples().view(), weights, &workers);
  }
  void waitAnywhere();
  void followMotion(const Pose2& odometry);
  void predict(const Pose2& odometry);
  void predictBlindly(Timestamp stamp);
  void spread(Timestamp stamp);
  void predictFor(Timestamp stamp);
  void enlarge();
  template <class Move>
  void move(const Move& moveSome);
  PoseEstimate estimateNow() const;
  /// What readings say, for all hypotheses. @param news borrowed
  Evidence evidenceOf(const std::vector<News>& news);
  void start(NewsByTime& news);
  void goOnStarting();
  static std::vector<const Weigher*> readingsOf(const std::vector<News>& news);
  void followFit(const std::vector<News>& news, const std::vector<double>& before);
  std::vector<double> takeIn(const std::vector<News>& news, const Evidence& evidence,
                             Hypothesis::Said said);
  std::vector<double> takeInUnsure(const std::vector<News>& news, const Evidence& evidence,
                                   Hypothesis::Said said);
  Hypothesis::Climb climbFor(const std::vector<News>& news, std::size_t had);
  bool compareDelays(const std::vector<News>& news, const Lateness::Moment& moment);
  bool compareWithRivals(const Evidence& evidence, const Rivals::Moment& moment);
  void resample(const std::vector<double>& weights, const PoseBins& bins);
  void keepResolution(PoseEstimate& e) const;
  PoseEstimate atStamp(const PoseEstimate& e, Timestamp stamp) const;
  /// Whether odometry says nothing of the way since the last weighing.
  bool drifts() const { return !lastOdometry || (trust.isLost() && isBlind); }
  void addDrift(PoseEstimate& e, Timestamp stamp) const;
  Signs signsAt(Timestamp stamp) const;
  void correct(const std::vector<News>& news, Timestamp stamp);
  void conclude(const std::vector<News>& news, std::vector<double> weights, Timestamp stamp,
                std::optional<Lateness::Moment> weighed = {});
};

}  // namespace ortung

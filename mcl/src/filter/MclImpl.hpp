#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "Confidence.hpp"
#include "Drift.hpp"
#include "Intake.hpp"
#include "Kld.hpp"
#include "LiftRides.hpp"
#include "MapWatch.hpp"
#include "Steps.hpp"
#include "Track.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/Mcl.hpp"

namespace ortung {

/// Streams of random numbers: one per purpose and step.
enum class Purpose : std::uint64_t { kMotion, kResampling, kStart, kRivals, kSpread, kCount };

// An update looks for new readings, and then does these steps for each time at which there are any:
// predict, weigh, lead, estimate, resample. Each step takes what the step before returns, so they
// can't be called in another order.

/// The readings of one time step.
struct Moment {
  Timestamp stamp;
  const std::vector<NewReading>* news;  ///< borrowed
  Evidence evidence;                    ///< likelihood of the readings
};
/// The result of predict(): all hypotheses are moved to the time of the readings.
struct Predicted {
  Timestamp stamp;
  std::size_t drifted = 0;  ///< first sample that was moved by process noise; zero: none
};
/// The result of weigh(): the readings have weighed the belief, whose likelihood the alternatives
/// are compared with.
struct Weighed {
  Moment moment;
  std::vector<double> weights;
  std::optional<Rivals::Moment> compared;  ///< nothing: the belief fits, there are no alternatives
  double logEvidence;                      ///< ln p(readings | belief)
};
/// The result of letBestLead(): the belief is the hypothesis that leads.
struct Led {
  Moment moment;
  std::vector<double> weights;
  PoseBins bins;
  PoseEstimate estimate;  ///< estimate of the samples alone
};
/// The result of estimateFrom(): the estimate is computed.
struct Estimated {
  std::vector<double> weights;
  PoseBins bins;
};

/// The filter in three parts: its public functions (Mcl.cpp), the prediction of samples
/// (MclPrediction.cpp), and their correction by readings (MclCorrection.cpp).
struct Mcl::Impl {
  /// The time and odometry up to which the samples were moved.
  struct Reached {
    std::optional<Pose2> odometry;   ///< odometry's pose up to which they were moved
    std::optional<Timestamp> stamp;  ///< stamp of the readings up to which they were moved
  };

  Tools tools;
  std::optional<Track> track;
  LastingParts parts;
  Intake intake;
  LiftRides rides;
  MapWatch map;  ///< where the map no longer fits
  Steps steps;   ///< how far updates move what is told
  Reached reached;
  double usualInterval = 0.0;  ///< usual time between weighings: the longest recent one [s]
  PoseEstimate estimate;       ///< estimate of the newest weighing
  std::uint64_t step = 0;

  Impl(const MclConfig& c, FieldRegion r, std::unique_ptr<MotionModel> m)
      : tools(c, std::move(r), std::move(m)),
        track(std::in_place, tools, SampleSet{}, true),
        parts{Lateness(tools.config, *tools.motion),
              Polish(tools.config.learnsOdometry),
              {},
              {},
              {tools.config, tools.region, tools.search, tools.workers}},
        intake(tools.config, *tools.motion),
        rides(tools.region) {}

  std::uint64_t stream(Purpose purpose) const {
    return step * static_cast<std::uint64_t>(Purpose::kCount) + static_cast<std::uint64_t>(purpose);
  }
  /// Returns by how much readings' stamps are late.
  Timestamp delay() const { return fromSeconds(parts.lateness.seconds()); }
  Random random(Purpose purpose) const { return Random(tools.config.seed, stream(purpose)); }

  // Public functions and their helpers.
  void forgetTimes();
  void forgetReadings();
  void begin(SampleSet samples, bool waits = false);
  void waitAnywhere();
  std::optional<Timestamp> newestTime() const;
  PoseEstimate estimateNow() const;
  PoseEstimate estimateAt(Timestamp stamp) const;
  PoseEstimate presentAt(Timestamp stamp) const;
  void keepResolution(PoseEstimate& e) const;
  PoseEstimate atStamp(const PoseEstimate& e, Timestamp stamp) const;
  bool drifts() const;
  void addDrift(PoseEstimate& e, Timestamp stamp) const;
  Signs signsAt(Timestamp stamp) const;
  std::optional<Pose2> changeTo(Timestamp stamp) const;
  ReadingsByTime look(const SensorContainer& container);
  void start(ReadingsByTime& news);
  void goOnStarting();
  void startFrom(const GlobalStart::Moment& then, SampleSet samples, std::size_t most);
  void goOnWithoutNews();

  // Predict.
  std::optional<Timestamp> silentSince(Timestamp stamp) const;
  std::optional<Timestamp> aloneSince(Timestamp stamp) const;
  bool isNear(Timestamp stamp) const;
  double secondsAlone(Timestamp stamp) const;
  void followMotion(const Pose2& odometry);
  [[nodiscard]] Predicted predict(Timestamp stamp);
  void moveBy(const Pose2& odometry);
  void moveBlindly(Timestamp stamp);
  std::size_t spread(Timestamp stamp);
  void enlarge();
  void rideLifts(Timestamp stamp);
  template <class MoveSome>
  void move(const MoveSome& moveSome);
  void followIntervals(Timestamp stamp);

  // Correct.
  void correctAt(Timestamp stamp, const std::vector<NewReading>& news);
  double sizeOfMoment(const std::vector<NewReading>& news) const;
  void watchMap(const std::vector<NewReading>& news, std::uint32_t relocalizations);
  void correct(const std::vector<NewReading>& news, Predicted predicted);
  Moment momentOf(const std::vector<NewReading>& news, Timestamp stamp);
  Hypothesis::Said ask(const Moment& moment, Predicted& predicted);
  [[nodiscard]] Weighed weigh(const std::vector<NewReading>& news, Predicted predicted);
  [[nodiscard]] Led letBestLead(Weighed weighed);
  [[nodiscard]] Estimated estimateFrom(Led led);
  void lookElsewhere(const Led& led);
  void estimateRoughly(const Led& led);
  void refine(const std::vector<NewReading>& news, std::size_t samples);
  PoseDistance othersOf(const Led& led) const;
  void followFloor(const Pose2& before);
  void resample(const Estimated& estimated);
  std::optional<Rivals::Moment> competition(const Moment& moment, const Hypothesis::Said& said);
  std::vector<double> takeIn(const Moment& moment, Hypothesis::Said& said);
  std::vector<double> takeInUnsure(const Moment& moment, Hypothesis::Said said,
                                   std::size_t drifted);
  SampleSet annealedOf(SampleSet samples, const Hypothesis::Said& said, const Moment& moment);
  Hypothesis::Climb climbFor(const std::vector<NewReading>& news, std::size_t had);
  bool letRivalLead(const Weighed& weighed);
  bool letDelayLead(const Led& led, const Weighed& weighed);
  Led ledBy(Moment moment, std::vector<double> weights);
  std::optional<double> fitOfBelief(const Moment& moment, const std::vector<double>& weights,
                                    const std::vector<float>& logs);
};

}  // namespace ortung

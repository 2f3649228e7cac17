// Hypotheses elsewhere: what a search of the whole field has found.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "BeliefTuning.hpp"
#include "Centre.hpp"
#include "Drift.hpp"
#include "MotionTuning.hpp"
#include "NewReadings.hpp"
#include "Rivals.hpp"
#include "RivalsTuning.hpp"
#include "SearchTuning.hpp"

namespace ortung {

using namespace tuning;

namespace {

/// Candidates of a drawing from what a search has found.
const double kDrawn = static_cast<double>(field::kCandidates * elsewhere::kSamples);

/// What a search has found.
struct Found {
  int alike = 0;          ///< number of places that explain the readings about as well as the best
  bool isUsual = false;   ///< whether the best one fits as well as usual, and well in itself
  bool isBetter = false;  ///< whether the belief explains them less well
};
Found foundBy(std::span<const FieldSearch::Place> places, const Rivals::Moment& moment,
              const Recovery& recovery) {
  std::vector<const Weigher*> readings;
  for (const auto& reading : moment.readings) readings.push_back(reading.get());
  std::vector<Pose2> poses;
  for (const FieldSearch::Place& place : places) poses.push_back(place.pose);
  if (poses.empty()) return {};
  const std::vector<double> fits = fitsAt(readings, poses);
  const double enough = elsewhere::kAsWell * fits.front();
  return {static_cast<int>(std::ranges::count_if(fits, [&](double fit) { return fit >= enough; })),
          fits.front() >= elsewhere::kWell && recovery.isUsual(fits.front()), moment.fit < enough};
}

}  // namespace

bool Rivals::Elsewhere::isConfirmed() const {
  return travelled >= hypothesis::kDistance && readings >= elsewhere::kReadings;
}

std::optional<Rivals::Takeover> Rivals::lookElsewhere(const Moment& moment,
                                                      const Recovery& recovery,
                                                      const Evidence& evidence) {
  travelledSinceSearch_ += moment.travelled;
  // What was found since the last readings is weighed by these already.
  drawIfDone(moment, recovery);
  std::optional<Takeover> takeover;
  if (elsewhere_) {
    elsewhere_->waited += moment.travelled;
    const auto samples = static_cast<double>(elsewhere_->hypothesis.samples().size());
    const UpdateTime::Step begins(time_, Work::kElsewhere,
                                  timeOf((1.0 + elsewhere::kLeastShare) * samples, moment));
    if (begins) takeover = followElsewhere(moment, recovery, evidence);
  }
  if (!takeover && mayFindBetter()) {
    search(moment, recovery);
    if (elsewhere_) takeover = takeOver(moment);
  }
  return takeover;
}

std::optional<Rivals::Takeover> Rivals::followElsewhere(const Moment& moment,
                                                        const Recovery& recovery,
                                                        const Evidence& evidence) {
  Hypothesis& rival = elsewhere_->hypothesis;
  elsewhere_->before = rival.lead();
  const double ratio = weighElsewhere(moment, evidence);
  const double fit = evidence.fit(rival.samples());
  const double most = fit < elsewhere::kWell ? lead::kMostNatsOfAReading : std::abs(ratio);
  const double travelled = std::exchange(elsewhere_->waited, 0.0);
  rival.count(std::clamp(ratio, -most, most), travelled / common::kIndependent,
              recovery.isUsual(fit));
  elsewhere_->travelled += travelled;
  ++elsewhere_->readings;
  if (auto takeover = takeOver(moment)) return takeover;
  if (rival.lead().isHopeless() || rival.unusual() >= elsewhere::kMostUnusual ||
      (recovery.hasRecovered() && rival.lead().nats() <= 0.0) ||
      isSame(centreOf(rival.samples()).pose, moment.predicted))
    elsewhere_.reset();
  return std::nullopt;
}

/// Lets the place elsewhere take over if it leads by enough, and is distinct or confirmed.
std::optional<Rivals::Takeover> Rivals::takeOver(const Moment& moment) {
  const Hypothesis& rival = elsewhere_->hypothesis;
  const bool isConfirmed = elsewhere_->isConfirmed();
  if (!rival.lead().isEnough() || !(elsewhere_->isDistinct || isConfirmed)) return std::nullopt;
  // A place that is near was probably reached by motion that odometry did not count.
  const bool isNear =
      distance(centreOf(rival.samples()).pose, moment.predicted) < around::kLargestRing;
  Takeover takeover{rival.samples(), 1.0, isNear ? Odometry::kWrong : Odometry::kUnheard,
                    isConfirmed};
  forget();
  return takeover;
}

/// @returns what the readings say for it against the belief [nats]
double Rivals::weighElsewhere(const Moment& moment, const Evidence& evidence) {
  Hypothesis& rival = elsewhere_->hypothesis;
  const Random random = Random(config_.seed, moment.stream).fork(2);
  const auto climb = [&] {
    const std::size_t all = rival.samples().size();
    const double share = shareInTime(static_cast<double>(all), elsewhere::kLeastShare, moment);
    const auto from = static_cast<std::size_t>(share * static_cast<double>(all));
    return Hypothesis::Climb{
        std::max<std::size_t>(from, 1), all, random.fork(0), random.fork(1), true,
        time_.endOf(Work::kAnnealing)};
  };
  return rival.weigh(evidence, config_, elsewhere::kEffective, climb).logEvidence -
         moment.logEvidence;
}

/// Returns whether a search may find a better place than the one that is followed: not from where
/// the last one was made, and not while readings fit at a distinct place.
bool Rivals::mayFindBetter() const {
  if (!elsewhere_ || searching_) return true;
  const Hypothesis& rival = elsewhere_->hypothesis;
  const bool fits = rival.lead().nats() > 0.0 && rival.unusual() == 0;
  return travelledSinceSearch_ >= trust::kIndependent && !(elsewhere_->isDistinct && fits);
}

/// Begins a search of the field, if the fit of the readings calls for it, and continues it.
void Rivals::search(const Moment& moment, const Recovery& recovery) {
  if (searching_ && searching_->job.isDone()) return;  // there was no time to draw from it
  if (!searching_ && (recovery.callsForSearch() || recovery.unusual() > 0)) {
    FieldSearch::Settings settings;
    settings.workers = &workers_;
    settings.cover = search_.cover();
    searching_.emplace(Searching{FieldSearch(region_, settings), moment,
                                 elsewhere_ ? elsewhere_->before : Lead()});
    travelledSinceSearch_ = 0.0;
    searching_->job.begin(moment.readings);
  }
  if (!searching_) return;
  searchOn();
  drawIfDone(moment, recovery);
}

/// Draws from what a search has found, once there is time.
void Rivals::drawIfDone(const Moment& moment, const Recovery& recovery) {
  if (!searching_ || !searching_->job.isDone()) return;
  const UpdateTime::Step begins(time_, Work::kDrawing,
                                timeOf(elsewhere::kLeastShare * kDrawn, searching_->moment));
  if (begins) drawElsewhere(moment, recovery);
}

/// Judges what a search has found.
Rivals::Finding Rivals::judge(const Searching& done, const Recovery& recovery) {
  const std::span<const FieldSearch::Place> places = done.job.places();
  if (places.empty()) return Finding();
  const Found found = foundBy(places, done.moment, recovery);
  if (!found.isUsual) ++inVain_;
  const double most =
      found.isUsual ? mostNatsFor(found.alike * (1 + inVain_)) : lead::kMostNatsOfAReading;
  const double ratio = places.front().logProbability - done.moment.logEvidence;
  if (!found.isBetter) sightings_.forget();
  const double seen = found.alike == 1 && found.isBetter
                          ? sightings_.see(places.front().pose, ratio, done.moment.odometry)
                          : 0.0;
  const bool isSeenAgain = seen >= lead::kEnoughNats;
  Finding finding{Lead(most), isSeenAgain || 2.0 * most >= lead::kEnoughNats};
  if (finding.isDistinct) finding.lead.count(ratio, 1.0);
  if (isSeenAgain) finding.lead.atLeast(seen);
  return finding;
}

/// Draws a hypothesis around the places found. The readings of the search count as evidence for it
/// only if hardly any other place explains them, or another search has found it before: otherwise
/// they have merely selected it. One that is followed is replaced only by such a place. In a crowd
/// readings fit nowhere, one after the other, so that each further search is one more chance to
/// find a wrong place.
void Rivals::drawElsewhere(const Moment& moment, const Recovery& recovery) {
  const Searching done = std::move(*searching_);
  searching_.reset();
  Finding finding = judge(done, recovery);
  const std::span<const FieldSearch::Place> places = done.job.places();
  std::vector<PoseSearch::Ring> rings;
  for (const FieldSearch::Place& place : places) {
    if (place.logProbability > places.front().logProbability + lead::kHopelessNats)
      rings.push_back({place.pose, common::kPlaceRadius, places::kTurn});
  }
  if (rings.empty() || (!finding.isDistinct && (elsewhere_ || !recovery.callsForSearch()))) return;
  Hypothesis drawn(drawnFrom(rings, done.moment));
  carryOn(drawn, done.moment, moment);
  const Pose2 there = centreOf(drawn.samples()).pose;
  if (isSame(there, moment.predicted)) return;
  // The search's readings counted for the one that is followed, too, and count once.
  if (elsewhere_ && isSame(centreOf(elsewhere_->hypothesis.samples()).pose, there))
    finding.lead.add(done.before);
  elsewhere_.emplace(Elsewhere{Hypothesis(drawn.samples(), finding.lead), finding.isDistinct});
}

SampleSet Rivals::drawnFrom(const std::vector<PoseSearch::Ring>& rings, const Moment& then) const {
  std::vector<NewReading> news;
  for (const auto& reading : then.readings) news.push_back({nullptr, 0, reading});
  const auto weigh = [&](const SampleSet& set, std::vector<float>& out) {
    ortung::weigh(news, set, &workers_, out);
  };
  const double share = shareInTime(kDrawn, elsewhere::kLeastShare, then);
  const auto samples = static_cast<std::size_t>(share * static_cast<double>(elsewhere::kSamples));
  return search_
      .drawFrom(rings, samples, static_cast<double>(field::kCandidates), weigh,
                Random(config_.seed, then.stream).fork(2), time_.endOf(Work::kAnnealing))
      .samples;
}

/// Moves a hypothesis from the time of the search's readings to the present one.
void Rivals::carryOn(Hypothesis& drawn, const Moment& then, const Moment& now) const {
  drawn.move(0, [&](const MovableSamples& some, std::size_t first) {
    if (then.odometry && now.odometry)
      motion_.sampleMotion(some, inverse(*then.odometry) * *now.odometry, config_.seed, now.stream,
                           first);
    else
      drift(config_, some, {}, driftSeconds(then.stamp, now.stamp), now.stream, first);
  });
}

}  // namespace ortung

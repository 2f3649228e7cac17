#include "GlobalStart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "BeliefTuning.hpp"
#include "Lead.hpp"
#include "Resampling.hpp"
#include "SearchTuning.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {

GlobalStart::GlobalStart(const MclConfig& config, const FieldRegion& region,
                         const PoseSearch& search, Workers& workers)
    : config_(config), region_(region), search_(search), workers_(workers) {}

void GlobalStart::prepare() {
  if (field_) return;
  FieldSearch::Settings settings;
  settings.workers = &workers_;
  settings.cover = search_.cover();
  field_.emplace(region_, settings);
}

void GlobalStart::forget() {
  moment_.reset();
  inside_.reset();
  around_.reset();
  gathering_.reset();
  others_.reset();
  beside_ = 0;
  isFound_ = false;
  if (field_) field_->begin({});
}

void GlobalStart::begin(Moment moment) {
  forget();
  moment_ = std::move(moment);
  std::vector<std::shared_ptr<const Weigher>> readings;
  for (const NewReading& one : moment_->news) readings.push_back(one.weigher);
  nanoseconds_ = nanosecondsOf(moment_->news) + tuning::start::kDrawNanoseconds;
  prepare();
  field_->begin(std::move(readings));
}

bool GlobalStart::work(double nominalMilliseconds, const IsOver& isOver) {
  double left = std::max(nominalMilliseconds, 1e-6);
  if (!isFound_) {
    const double before = field_->workedMilliseconds();
    const bool wasDone = field_->isDone();
    if (!field_->work(left, isOver)) return false;
    left -= field_->workedMilliseconds() - before;
    if (!wasDone && isNow(isOver)) return false;
    beginAround();
    isFound_ = true;
    if (isNow(isOver)) return false;
  }
  if (inside_ && !gatherAround(isOver)) return false;
  if (around_ && !around_->draw.isDone() && !drawOn(*around_, left, isOver)) return false;
  if (beside_ == 0) return true;
  if (!others_) {
    if (left <= 0.0) return false;
    if (!gatherBeside(isOver)) return false;
  }
  return drawOn(*others_, left, isOver);
}

/// Continues a drawing.
/// @param left nominal time that is left [ms]; the time used is subtracted
/// @returns whether the drawing is done, and there is time for more
bool GlobalStart::drawOn(PoseSearch::Drawing& drawing, double& left, const IsOver& isOver) const {
  const double most = isOver ? double{kTimedPoses} : 1e9;
  while (!drawing.draw.isDone()) {
    if (left <= 0.0) return false;
    const double affordable = std::clamp(1e6 * left / nanoseconds_, 1.0, most);
    const std::size_t weighed = drawing.draw.work(static_cast<std::size_t>(affordable));
    left -= 1e-6 * static_cast<double>(weighed) * nanoseconds_;
    if (isNow(isOver)) return false;
  }
  return true;
}

PoseSearch::Weigh GlobalStart::weigher() const {
  return [this](const SampleSet& set, std::vector<float>& out) {
    ortung::weigh(moment_->news, set, &workers_, out);
  };
}

/// Returns a weigher by which a place is at most 4 nats worse than the best one. One reading must
/// not decide, however certain its sensor model is, since errors within one reading are correlated.
PoseSearch::Weigh GlobalStart::cautiousWeigher() const {
  std::vector<std::pair<PoseSearch::Ring, float>> raised;
  const std::span<const FieldSearch::Place> places = field_->places();
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    const double worse = places.front().logProbability - places[i].logProbability;
    if (worse > tuning::lead::kMostNatsOfAReading)
      raised.emplace_back(rings_[i], static_cast<float>(worse - tuning::lead::kMostNatsOfAReading));
  }
  return [plain = weigher(), raised = std::move(raised)](const SampleSet& set,
                                                         std::vector<float>& out) {
    plain(set, out);
    for (std::size_t i = 0; i < set.size(); ++i) {
      for (const auto& [ring, nats] : raised) {
        if (!PoseSearch::isWithin(ring, set.x[i], set.y[i], set.theta[i])) continue;
        out[i] += nats;
        break;
      }
    }
  };
}

void GlobalStart::beginAround() {
  rings_ = found();
  const bool areAll = !rings_.empty() && !areNotAll();
  const std::size_t most = areAll ? config_.maxSamples : config_.maxSamples / 2;
  const std::size_t n =
      rings_.empty()
          ? 0
          : std::min(most, tuning::start::kSamples + tuning::start::kSamplesAPlace * rings_.size());
  if (n > 0)
    inside_.emplace(search_, rings_, n, static_cast<double>(tuning::field::kCandidates),
                    Random(config_.seed, moment_->stream).fork(0));
  beside_ = areAll ? 0 : config_.maxSamples - n;
}

/// @returns whether all candidates around places are gathered, and there is time for more
bool GlobalStart::gatherAround(const IsOver& isOver) {
  while (!inside_->gather(kTimedPoses))
    if (isNow(isOver)) return false;
  around_.emplace(inside_->drawing(beside_ == 0 ? cautiousWeigher() : weigher()));
  inside_.reset();
  return !isNow(isOver);
}

/// @returns whether all candidates are gathered, and there is time for more
bool GlobalStart::gatherBeside(const IsOver& isOver) {
  if (!gathering_) {
    if (!around_) rings_.clear();
    gathering_.emplace(search_, rings_, beside_, candidatesFor(beside_),
                       Random(config_.seed, moment_->stream).fork(1));
  }
  while (!gathering_->gather(kTimedPoses))
    if (isNow(isOver)) return false;
  others_.emplace(gathering_->drawing(weigher()));
  gathering_.reset();
  return !isNow(isOver);
}

std::size_t GlobalStart::size() const {
  return (around_ ? around_->draw.size() : 0) + (others_ ? others_->draw.size() : 0);
}

/// Mixes both sets by their evidence.
SampleSet GlobalStart::take() {
  std::optional<PoseSearch::Drawn> around;
  std::optional<PoseSearch::Drawn> beside;
  if (around_) around = around_->take();
  if (others_) beside = others_->take();
  forget();
  if (!beside || beside->samples.size() == 0) return std::move(around->samples);
  if (!around) return std::move(beside->samples);
  const double share = 1.0 / (1.0 + std::exp(around->logEvidence - beside->logEvidence));
  if (share < tuning::start::kLeastShare) return std::move(around->samples);
  if (share > 1.0 - tuning::start::kLeastShare) return std::move(beside->samples);
  add(around->samples, beside->samples, share);
  return std::move(around->samples);
}

/// Returns a ring around each place that fits well enough.
std::vector<PoseSearch::Ring> GlobalStart::found() const {
  const std::span<const FieldSearch::Place> places = field_->places();
  std::vector<PoseSearch::Ring> rings;
  for (const FieldSearch::Place& place : places)
    if (place.logProbability > places.front().logProbability - tuning::start::kNats)
      rings.push_back({place.pose, tuning::common::kPlaceRadius, tuning::places::kTurn});
  return rings;
}

/// Returns whether there may be more places, or whether the readings fit outside of the rings about
/// as well as within.
bool GlobalStart::areNotAll() const {
  using tuning::places::kTurn;
  const double radius = tuning::common::kPlaceRadius;
  const std::array<Pose2, 6> edgesOfRing = {Pose2{radius, 0, 0}, {-radius, 0, 0}, {0, radius, 0},
                                            {0, -radius, 0},     {0, 0, kTurn},   {0, 0, -kTurn}};
  const FieldSearch::Settings settings;
  if (rings_.size() >= settings.places) return true;
  SampleSet edges;
  std::vector<double> tops;
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    for (const Pose2& edge : edgesOfRing) {
      const Pose2& top = rings_[i].pose;
      const Pose2 pose{top.x + edge.x, top.y + edge.y, top.theta + edge.theta};
      const bool isOfAnother =
          std::any_of(rings_.begin(), rings_.end(), [&](const PoseSearch::Ring& ring) {
            return &ring != &rings_[i] && distance(ring.pose, pose) < settings.apartMetres &&
                   std::abs(wrapAngle(ring.pose.theta - pose.theta)) < settings.apartRadians;
          });
      const std::ptrdiff_t cell = region_.grid.cellAt(pose.x, pose.y);
      if (isOfAnother || cell < 0 || region_.standable[static_cast<std::size_t>(cell)] == 0)
        continue;
      edges.x.push_back(static_cast<float>(pose.x));
      edges.y.push_back(static_cast<float>(pose.y));
      edges.theta.push_back(static_cast<float>(pose.theta));
      edges.logWeight.push_back(0.0F);
      tops.push_back(field_->places()[i].logProbability);
    }
  }
  std::vector<float> logs;
  ortung::weigh(moment_->news, edges, nullptr, logs);
  for (std::size_t i = 0; i < logs.size(); ++i)
    if (static_cast<double>(logs[i]) > tops[i] - tuning::start::kEdgeNats) return true;
  return false;
}

/// Returns the number of candidates per sample all over the floor. The peak around the true pose
/// must be hit a few times, so their total number is proportional to the area.
double GlobalStart::candidatesFor(std::size_t samples) const {
  const double area = static_cast<double>(search_.cells()) * region_.grid.cell * region_.grid.cell;
  const double all = std::min(config_.startCandidates * area, tuning::start::kMostCandidates);
  return std::max(all / static_cast<double>(samples), tuning::start::kFewestCandidates);
}

}  // namespace ortung

#include "FieldSearch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "BeliefTuning.hpp"
#include "NominalTime.hpp"
#include "Parallel.hpp"
#include "SearchTuning.hpp"
#include "ortung/core/BlurrableWeigher.hpp"

namespace ortung {
namespace {

using namespace tuning::field;
using tuning::common::kPlaceMetres, tuning::common::kPlaceRadians;

/// Bound of |ln p| of one time step's readings, whatever plugins return.
constexpr float kMostNats = 1e4F;
constexpr float kNowhere = -std::numeric_limits<float>::infinity();
constexpr std::size_t kBatch = 8 * kChunk;
constexpr std::size_t kParts = 8;  ///< parts that a pose is divided into
/// Candidates of a climbing step: the pose and 6 neighbours.
constexpr std::size_t kNeighbours = 7;
/// Candidates that are considered at once: each is compared with up to two hundred others.
constexpr std::size_t kConsidered = 64;

void require(bool holds, const char* what, double value) {
  if (!holds)
    throw std::invalid_argument(std::string("search of the field: ") + what + ", not " +
                                std::to_string(value));
}

}  // namespace

void FieldSearch::Settings::check() const {
  require(spacing > 0.0 && spacing <= 100.0, "spacing is in (0, 100] m", spacing);
  require(headings >= 1 && headings <= 3600, "there are 1 to 3600 headings", headings);
  require(survivors >= 1, "survivors are 1 at least", static_cast<double>(survivors));
  require(places >= 1, "places are 1 at least", static_cast<double>(places));
  require(apartMetres >= 0.0, "places are 0 m apart or more", apartMetres);
  require(apartRadians >= 0.0, "places are 0 rad apart or more", apartRadians);
}

FieldSearch::FieldSearch(const FieldRegion& region, const Settings& settings)
    : region_(region), settings_(settings), cover_(settings.cover) {
  settings_.check();
  if (!cover_) cover_ = std::make_shared<FieldCover>(region, settings.spacing);
}

FieldSearch::Readings FieldSearch::blurredBy(const PoseResolution& spread) const {
  Readings readings;
  for (const std::shared_ptr<const Weigher>& sharp : sharp_.weighers) {
    std::shared_ptr<const Weigher> weigher = sharp;
    if (const auto* blurrable = dynamic_cast<const BlurrableWeigher*>(sharp.get()))
      weigher = blurrable->blurred(spread);
    readings.nanoseconds += nominalNanoseconds(*weigher);
    readings.weighers.push_back(std::move(weigher));
  }
  return readings;
}

void FieldSearch::begin(std::vector<std::shared_ptr<const Weigher>> readings) {
  std::erase(readings, nullptr);
  places_.clear();
  parents_.clear();
  kept_.clear();
  isPruned_ = false;
  choice_.reset();
  next_ = 0;
  worked_ = 0.0;
  double nanoseconds = 0.0;
  for (const auto& reading : readings) nanoseconds += nominalNanoseconds(*reading);
  sharp_ = {std::move(readings), nanoseconds};
  spacing_ = cover_->spacing;
  turn_ = 2.0 * std::numbers::pi / settings_.headings;
  const bool isNothing = cover_->cells.empty() || sharp_.weighers.empty();
  stage_ = isNothing ? Stage::kDone : Stage::kCover;
  if (isNothing) return;
  present_ = blurredBy({kBlur * spacing_, kBlur * turn_});
  nanosecondsOfCover_ = present_.nanoseconds;
}

std::size_t FieldSearch::posesInStage() const {
  if (stage_ == Stage::kCover)
    return cover_->cells.size() * static_cast<std::size_t>(settings_.headings);
  return parents_.size() * (stage_ == Stage::kDivide ? kParts : kNeighbours);
}

Pose2 FieldSearch::poseAt(std::size_t number) const {
  if (stage_ == Stage::kCover) {  // all headings of a cell in a row, while it is cached
    const auto headings = static_cast<std::size_t>(settings_.headings);
    const std::uint32_t cell = cover_->cells[number / headings];
    return {region_.grid.centreX(cell), region_.grid.centreY(cell),
            static_cast<double>(number % headings) * turn_};
  }
  if (stage_ == Stage::kDivide) {
    const Pose2& parent = parents_[number / kParts].pose;
    Pose2 pose = parent;
    const std::size_t part = number % kParts;
    pose.x += (part & 1U) != 0 ? 0.5 * spacing_ : -0.5 * spacing_;
    pose.y += (part & 2U) != 0 ? 0.5 * spacing_ : -0.5 * spacing_;
    if (!isStandable(pose)) pose = parent;  // headings are divided in narrow places, too
    pose.theta += (part & 4U) != 0 ? 0.5 * turn_ : -0.5 * turn_;
    return pose;
  }
  Pose2 pose = parents_[number / kNeighbours].pose;
  const std::size_t neighbour = number % kNeighbours;
  const double sign = neighbour % 2 == 0 ? 1.0 : -1.0;
  if (neighbour == 1 || neighbour == 2) pose.x += sign * spacing_;
  if (neighbour == 3 || neighbour == 4) pose.y += sign * spacing_;
  if (neighbour == 5 || neighbour == 6) pose.theta += sign * turn_;
  return pose;
}

bool FieldSearch::isStandable(const Pose2& pose) const {
  const std::ptrdiff_t cell = region_.grid.cellAt(pose.x, pose.y);
  return cell >= 0 && region_.standable[static_cast<std::size_t>(cell)] != 0;
}

/// Weighs the next poses of this stage.
void FieldSearch::weigh(std::size_t count) {
  batch_.resize(count);
  std::fill(batch_.logWeight.begin(), batch_.logWeight.end(), 0.0F);
  forEachChunk(count, settings_.workers, [&](std::size_t first, std::size_t n) {
    for (std::size_t i = first; i < first + n; ++i) {
      const Pose2 pose = poseAt(next_ + i);
      batch_.x[i] = static_cast<float>(pose.x);
      batch_.y[i] = static_cast<float>(pose.y);
      batch_.theta[i] = static_cast<float>(pose.theta);
    }
    const std::span<float> logs = std::span(batch_.logWeight).subspan(first, n);
    for (const std::shared_ptr<const Weigher>& weigher : present_.weighers)
      weigher->getProbability(batch_.view().part(first, n), logs);
    for (float& log : logs)
      log = std::isfinite(log) ? std::clamp(log, -kMostNats, kMostNats) : -kMostNats;
  });
}

bool FieldSearch::work(double nominalMilliseconds, const IsOver& isOver) {
  double nanoseconds = 1e6 * nominalMilliseconds;
  do {
    if (stage_ == Stage::kDone) return true;
    if (next_ < posesInStage()) weighNext(nanoseconds, isOver);
    if (next_ == posesInStage() && !endStage(isOver)) return false;
  } while (nanoseconds > 0.0 && !isNow(isOver));
  return isDone();
}

/// Weighs the next poses of this stage. @param nanoseconds nominal time that is left
void FieldSearch::weighNext(double& nanoseconds, const IsOver& isOver) {
  std::size_t count = std::min(posesInStage() - next_, isOver ? kTimedPoses : kBatch);
  const double affordable = std::max(1.0, nanoseconds / present_.nanoseconds);
  if (affordable < static_cast<double>(count)) count = static_cast<std::size_t>(affordable);
  weigh(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Pose2 pose = poseAt(next_ + i);
    const bool stands = stage_ != Stage::kClimb || isStandable(pose);
    if (stands) keep({pose, batch_.logWeight[i], next_ + i});
  }
  nanoseconds -= static_cast<double>(count) * present_.nanoseconds;
  worked_ += static_cast<double>(count) * present_.nanoseconds;
  next_ += count;
}

void FieldSearch::keep(const Candidate& weighed) {
  if (stage_ == Stage::kClimb) {
    Candidate& soFar = kept_[weighed.number / kNeighbours];
    if (weighed.isBetterThan(soFar)) soFar = weighed;
    return;
  }
  if (isPruned_ && !weighed.isBetterThan(kept_[crowd() - 1])) return;
  kept_.push_back(weighed);
  if (kept_.size() >= 2 * crowd()) prune();
}

std::size_t FieldSearch::crowd() const { return kCandidates * settings_.survivors; }

/// Removes the worst candidates. The result does not depend on when this is done.
void FieldSearch::prune() {
  if (kept_.size() <= crowd()) return;
  const auto worst = kept_.begin() + static_cast<std::ptrdiff_t>(crowd()) - 1;
  std::nth_element(kept_.begin(), worst, kept_.end(),
                   [](const Candidate& a, const Candidate& b) { return a.isBetterThan(b); });
  kept_.resize(crowd());
  isPruned_ = true;
}

/// Chooses those that the next stage treats. No nominal time is counted for it, so without a clock
/// it is done at once.
/// @returns whether the next stage has begun; false: the time is over
bool FieldSearch::endStage(const IsOver& isOver) {
  if (stage_ == Stage::kClimb && climbOn()) return true;
  if (!choice_) {
    beginChoice();
    if (isNow(isOver)) return false;
  }
  while (!chooseSome())
    if (isNow(isOver)) return false;
  next_ = 0;
  isPruned_ = false;
  if (stage_ == Stage::kClimb)
    finish();
  else if (spacing_ > kFinest)
    divide();
  else
    beginClimb();
  choice_.reset();
  return true;
}

void FieldSearch::beginChoice() {
  countOfPlace_.clear();
  if (stage_ == Stage::kClimb) {
    choice_.emplace(std::move(kept_), settings_.places);
    return;
  }
  prune();
  choice_.emplace(std::move(kept_),
                  spacing_ > kFinest ? settings_.survivors : kCandidates * settings_.places);
}

/// Survivors may be near each other, but only a limited number is chosen from each place. Places,
/// and what climbs to them, are those that have no better one within both distances.
/// @returns whether the choice is made
bool FieldSearch::chooseSome() {
  if (stage_ != Stage::kClimb && spacing_ > kFinest)
    return choice_->consider(
        kConsidered, [this](const Candidate& one, const auto&) { return isWantedOfPlace(one); });
  const double share = stage_ == Stage::kClimb ? 1.0 : 0.5;
  const double metres = share * settings_.apartMetres;
  const double radians = share * settings_.apartRadians;
  return choice_->consider(kConsidered, [=](const Candidate& one, const auto& chosen) {
    return std::none_of(chosen.begin(), chosen.end(), [&](const Candidate& better) {
      const double x = one.pose.x - better.pose.x;
      const double y = one.pose.y - better.pose.y;
      return x * x + y * y < metres * metres &&
             std::abs(wrapAngle(one.pose.theta - better.pose.theta)) < radians;
    });
  });
}

bool FieldSearch::isWantedOfPlace(const Candidate& one) {
  const std::array<long, 3> place{std::lround(one.pose.x / kPlaceMetres),
                                  std::lround(one.pose.y / kPlaceMetres),
                                  std::lround(wrapAngle(one.pose.theta) / kPlaceRadians)};
  return countOfPlace_[place]++ < kSurvivorsAPlace;
}

void FieldSearch::divide() {
  stage_ = Stage::kDivide;
  spacing_ *= 0.5;
  turn_ *= 0.5;
  parents_ = choice_->take();
  kept_.clear();
  present_ = spacing_ > kFinest ? blurredBy({kBlur * spacing_, kBlur * turn_}) : sharp_;
}

void FieldSearch::beginClimb() {
  stage_ = Stage::kClimb;
  present_ = sharp_;
  climbs_ = 0;
  parents_ = choice_->take();
  spacing_ *= 0.5;
  turn_ *= 0.5;
  kept_.assign(parents_.size(), {{}, kNowhere, 0});
}

/// @returns whether there is another step
bool FieldSearch::climbOn() {
  if (parents_.empty() || climbs_ + 1 == kClimbs) return false;
  ++climbs_;
  next_ = 0;
  if (climbs_ % kClimbsAStep == 0) {
    spacing_ *= 0.5;
    turn_ *= 0.5;
  }
  parents_ = std::move(kept_);
  kept_.assign(parents_.size(), {{}, kNowhere, 0});
  return true;
}

void FieldSearch::finish() {
  for (const Candidate& found : choice_->take())
    places_.push_back({{found.pose.x, found.pose.y, wrapAngle(found.pose.theta)},
                       static_cast<double>(found.logProbability)});
  stage_ = Stage::kDone;
  sharp_.weighers.clear();  // tables may be large, and are not needed any more
  present_.weighers.clear();
}

double FieldSearch::nominalMilliseconds() const {
  if (cover_->cells.empty() || sharp_.nanoseconds == 0.0) return 0.0;
  const auto all = [](std::size_t n, std::size_t times, double nanoseconds) {
    return static_cast<double>(n) * static_cast<double>(times) * nanoseconds;
  };
  double sum =
      all(cover_->cells.size(), static_cast<std::size_t>(settings_.headings), nanosecondsOfCover_);
  for (double spacing = cover_->spacing; spacing > kFinest; spacing *= 0.5)
    sum += all(settings_.survivors, kParts, sharp_.nanoseconds);
  sum += all(kCandidates * settings_.places, kNeighbours * kClimbs, sharp_.nanoseconds);
  return 1e-6 * sum;
}

}  // namespace ortung

#include "FieldSearch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
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
    : region_(region), settings_(settings) {
  settings_.check();
  makeCover();
}

/// Divides the floor into square blocks of cells, and takes from each the standable cell nearest to
/// its centre, so that narrow places are covered, too.
void FieldSearch::makeCover() {
  const FieldGrid& grid = region_.grid;
  const int edge = std::max(1, static_cast<int>(std::lround(settings_.spacing / grid.cell)));
  spacingOfCover_ = edge * grid.cell;
  const int columns = (grid.columns + edge - 1) / edge;
  const int rows = (grid.rows + edge - 1) / edge;
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  struct Nearest {
    int squared = std::numeric_limits<int>::max();
    std::size_t cell = kNone;
  };
  std::vector<Nearest> blocks(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (std::size_t cell = 0; cell < region_.standable.size(); ++cell) {
    if (region_.standable[cell] == 0) continue;
    const int column = static_cast<int>(cell % static_cast<std::size_t>(grid.columns));
    const int row = static_cast<int>(cell / static_cast<std::size_t>(grid.columns));
    const int across = 2 * (column % edge) - edge + 1;
    const int along = 2 * (row % edge) - edge + 1;
    const int squared = across * across + along * along;
    Nearest& block =
        blocks[static_cast<std::size_t>(row / edge) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column / edge)];
    if (squared < block.squared) block = {squared, cell};
  }
  for (const Nearest& block : blocks)
    if (block.cell != kNone) cover_.push_back(static_cast<std::uint32_t>(block.cell));
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
  next_ = 0;
  worked_ = 0.0;
  double nanoseconds = 0.0;
  for (const auto& reading : readings) nanoseconds += nominalNanoseconds(*reading);
  sharp_ = {std::move(readings), nanoseconds};
  spacing_ = spacingOfCover_;
  turn_ = 2.0 * std::numbers::pi / settings_.headings;
  const bool isNothing = cover_.empty() || sharp_.weighers.empty();
  stage_ = isNothing ? Stage::kDone : Stage::kCover;
  if (isNothing) return;
  present_ = blurredBy({kBlur * spacing_, kBlur * turn_});
  nanosecondsOfCover_ = present_.nanoseconds;
}

std::size_t FieldSearch::posesInStage() const {
  if (stage_ == Stage::kCover) return cover_.size() * static_cast<std::size_t>(settings_.headings);
  return parents_.size() * (stage_ == Stage::kDivide ? kParts : kNeighbours);
}

Pose2 FieldSearch::poseAt(std::size_t number) const {
  if (stage_ == Stage::kCover) {  // all headings of a cell in a row, while it is cached
    const auto headings = static_cast<std::size_t>(settings_.headings);
    const std::uint32_t cell = cover_[number / headings];
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

bool FieldSearch::work(double nominalMilliseconds) {
  double nanoseconds = 1e6 * nominalMilliseconds;
  do {
    if (stage_ == Stage::kDone) return true;
    std::size_t count = std::min(posesInStage() - next_, kBatch);
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
    if (next_ == posesInStage()) endStage();
  } while (nanoseconds > 0.0);
  return isDone();
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

void FieldSearch::endStage() {
  next_ = 0;
  if (stage_ == Stage::kClimb) {
    climbOn();
    return;
  }
  prune();
  isPruned_ = false;
  if (spacing_ > kFinest)
    divide();
  else
    beginClimb();
}

/// Returns the best of those kept, best first, but only a limited number from each place.
std::vector<FieldSearch::Candidate> FieldSearch::survivors() {
  std::sort(kept_.begin(), kept_.end(),
            [](const Candidate& a, const Candidate& b) { return a.isBetterThan(b); });
  std::map<std::array<long, 3>, std::size_t> counts;
  std::vector<Candidate> chosen;
  for (const Candidate& one : kept_) {
    if (chosen.size() == settings_.survivors) break;
    const std::array<long, 3> place{std::lround(one.pose.x / kPlaceMetres),
                                    std::lround(one.pose.y / kPlaceMetres),
                                    std::lround(wrapAngle(one.pose.theta) / kPlaceRadians)};
    if (counts[place]++ < kSurvivorsAPlace) chosen.push_back(one);
  }
  return chosen;
}

void FieldSearch::divide() {
  stage_ = Stage::kDivide;
  spacing_ *= 0.5;
  turn_ *= 0.5;
  parents_ = survivors();
  kept_.clear();
  present_ = spacing_ > kFinest ? blurredBy({kBlur * spacing_, kBlur * turn_}) : sharp_;
}

void FieldSearch::beginClimb() {
  stage_ = Stage::kClimb;
  present_ = sharp_;
  climbs_ = 0;
  parents_ = apart(kCandidates * settings_.places, 0.5 * settings_.apartMetres,
                   0.5 * settings_.apartRadians);
  spacing_ *= 0.5;
  turn_ *= 0.5;
  kept_.assign(parents_.size(), {{}, kNowhere, 0});
  if (parents_.empty()) finish();
}

void FieldSearch::climbOn() {
  ++climbs_;
  if (climbs_ == kClimbs) {
    finish();
    return;
  }
  if (climbs_ % kClimbsAStep == 0) {
    spacing_ *= 0.5;
    turn_ *= 0.5;
  }
  parents_ = kept_;
  kept_.assign(parents_.size(), {{}, kNowhere, 0});
}

/// Returns the best of those kept, best first, without those that have a better one within both
/// distances.
std::vector<FieldSearch::Candidate> FieldSearch::apart(std::size_t most, double metres,
                                                       double radians) {
  std::sort(kept_.begin(), kept_.end(),
            [](const Candidate& a, const Candidate& b) { return a.isBetterThan(b); });
  std::vector<Candidate> chosen;
  for (const Candidate& one : kept_) {
    if (chosen.size() == most) break;
    const bool isSame = std::any_of(chosen.begin(), chosen.end(), [&](const Candidate& better) {
      const double x = one.pose.x - better.pose.x;
      const double y = one.pose.y - better.pose.y;
      return x * x + y * y < metres * metres &&
             std::abs(wrapAngle(one.pose.theta - better.pose.theta)) < radians;
    });
    if (!isSame) chosen.push_back(one);
  }
  return chosen;
}

void FieldSearch::finish() {
  for (const Candidate& found :
       apart(settings_.places, settings_.apartMetres, settings_.apartRadians))
    places_.push_back({{found.pose.x, found.pose.y, wrapAngle(found.pose.theta)},
                       static_cast<double>(found.logProbability)});
  stage_ = Stage::kDone;
  sharp_.weighers.clear();  // tables may be large, and are not needed any more
  present_.weighers.clear();
}

double FieldSearch::nominalMilliseconds() const {
  if (cover_.empty() || sharp_.nanoseconds == 0.0) return 0.0;
  const auto all = [](std::size_t n, std::size_t times, double nanoseconds) {
    return static_cast<double>(n) * static_cast<double>(times) * nanoseconds;
  };
  double sum =
      all(cover_.size(), static_cast<std::size_t>(settings_.headings), nanosecondsOfCover_);
  for (double spacing = spacingOfCover_; spacing > kFinest; spacing *= 0.5)
    sum += all(settings_.survivors, kParts, sharp_.nanoseconds);
  sum += all(kCandidates * settings_.places, kNeighbours * kClimbs, sharp_.nanoseconds);
  return 1e-6 * sum;
}

}  // namespace ortung

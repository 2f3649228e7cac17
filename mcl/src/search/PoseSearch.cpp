#include "PoseSearch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "IsOver.hpp"
#include "Resampling.hpp"

namespace ortung {
namespace {

PoseSearch::Drawn toTheEnd(PoseSearch::Drawing drawing, const IsOver& isOver) {
  drawing.draw.finish(isOver);
  return drawing.take();
}

void append(SampleSet& set, float x, float y, float theta) {
  set.x.push_back(x);
  set.y.push_back(y);
  set.theta.push_back(theta);
  set.logWeight.push_back(0.0F);
}

void append(SampleSet& set, const SampleSet& some, const Annealing::Within& within) {
  for (std::size_t i = 0; i < some.size(); ++i)
    if (within(some.x[i], some.y[i], some.theta[i]))
      append(set, some.x[i], some.y[i], some.theta[i]);
}

}  // namespace

PoseSearch::Drawn PoseSearch::Drawing::take() {
  Drawn drawn = draw.take();
  drawn.logEvidence += logShare;
  return drawn;
}

PoseSearch::PoseSearch(const FieldRegion& region)
    : region_(region), cover_(std::make_shared<FieldCover>(region)) {
  for (std::size_t cell = 0; cell < region.standable.size(); ++cell) {
    if (region.standable[cell] != 0) standable_.push_back(static_cast<std::uint32_t>(cell));
  }
}

SampleSet PoseSearch::anywhere(std::size_t n, Random random) const {
  SampleSet set;
  addAnywhere(n, random, set);
  return set;
}

void PoseSearch::addAnywhere(std::size_t n, Random& random, SampleSet& set) const {
  const std::size_t had = set.size();
  set.resize(had + n);
  const double half = 0.5 * region_.grid.cell;
  for (std::size_t i = had; i < had + n; ++i) {
    const std::uint32_t cell = standable_[random.below(standable_.size())];
    set.x[i] = static_cast<float>(region_.grid.centreX(cell) + random.uniform(-half, half));
    set.y[i] = static_cast<float>(region_.grid.centreY(cell) + random.uniform(-half, half));
    set.theta[i] = static_cast<float>(random.uniform(-std::numbers::pi, std::numbers::pi));
    set.logWeight[i] = 0.0F;
  }
}

SampleSet PoseSearch::around(const Ring& ring, std::size_t n, Random random) {
  return someAround(ring, n, random);
}

SampleSet PoseSearch::someAround(const Ring& ring, std::size_t n, Random& random) {
  SampleSet set;
  set.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double distance = ring.radius * std::sqrt(random.uniform());
    const double direction = random.uniform(-std::numbers::pi, std::numbers::pi);
    set.x[i] = static_cast<float>(ring.pose.x + distance * std::cos(direction));
    set.y[i] = static_cast<float>(ring.pose.y + distance * std::sin(direction));
    set.theta[i] = static_cast<float>(ring.pose.theta + random.uniform(-ring.turn, ring.turn));
    set.logWeight[i] = 0.0F;
  }
  return set;
}

bool PoseSearch::isWithin(const Ring& ring, float x, float y, float theta) {
  const double dx = static_cast<double>(x) - ring.pose.x;
  const double dy = static_cast<double>(y) - ring.pose.y;
  return dx * dx + dy * dy <= ring.radius * ring.radius &&
         std::abs(wrapAngle(static_cast<double>(theta) - ring.pose.theta)) <= ring.turn;
}

Annealing::Within PoseSearch::within(std::span<const Ring> rings) {
  return [all = std::vector<Ring>(rings.begin(), rings.end())](float x, float y, float theta) {
    return std::any_of(all.begin(), all.end(),
                       [&](const Ring& ring) { return isWithin(ring, x, y, theta); });
  };
}

/// Returns whether a pose is on a standable cell and @p also holds.
Annealing::Within PoseSearch::standable(Within also) const {
  return [this, also = std::move(also)](float x, float y, float theta) {
    const std::ptrdiff_t cell = region_.grid.cellAt(x, y);
    return cell >= 0 && region_.standable[static_cast<std::size_t>(cell)] != 0 && also(x, y, theta);
  };
}

PoseSearch::Drawn PoseSearch::draw(std::size_t n, double candidates, const Weigh& weigh,
                                   const Random& random, const std::optional<Ring>& ring,
                                   const IsOver& isOver) const {
  if (!ring) {
    Beside beside(*this, {}, n, candidates, random);
    while (!beside.gather(kTimedPoses)) continue;
    return toTheEnd(beside.drawing(weigh), isOver);
  }
  const auto tried = static_cast<std::size_t>(candidates * static_cast<double>(n));
  return Annealing(weigh, within({&*ring, 1}))
      .draw(around(*ring, tried, random.fork(0)), n, random, isOver);
}

PoseSearch::Beside::Beside(const PoseSearch& search, std::span<const Ring> rings, std::size_t n,
                           double candidates, const Random& random)
    : search_(search),
      within_(search.standable([inRings = PoseSearch::within(rings)](float x, float y, float t) {
        return !inRings(x, y, t);
      })),
      n_(n),
      all_(static_cast<std::size_t>(candidates * static_cast<double>(n))),
      random_(random),
      places_(random.fork(0)) {}

bool PoseSearch::Beside::gather(std::size_t most) {
  const std::size_t count = std::min(most, all_ - tried_);
  SampleSet some;
  search_.addAnywhere(count, places_, some);
  append(set_, some, within_);
  tried_ += count;
  return tried_ == all_;
}

PoseSearch::Drawing PoseSearch::Beside::drawing(const Weigh& weigh) {
  if (set_.size() == 0) return {{Annealing(weigh, within_), {}, 0, random_}, 0.0};
  const double share = static_cast<double>(set_.size()) / static_cast<double>(all_);
  return {{Annealing(weigh, within_), std::move(set_), n_, random_}, std::log(share)};
}

PoseSearch::Drawn PoseSearch::drawFrom(std::span<const Ring> rings, std::size_t n,
                                       double candidates, const Weigh& weigh, const Random& random,
                                       const IsOver& isOver) const {
  Inside inside(*this, rings, n, candidates, random);
  while (!inside.gather(kTimedPoses)) continue;
  return toTheEnd(inside.drawing(weigh), isOver);
}

// The rings' streams of random numbers are beyond those of the annealing.
PoseSearch::Inside::Inside(const PoseSearch& search, std::span<const Ring> rings, std::size_t n,
                           double candidates, const Random& random)
    : search_(search),
      rings_(rings.begin(), rings.end()),
      within_(search.standable(PoseSearch::within(rings))),
      n_(n),
      each_((static_cast<std::size_t>(candidates * static_cast<double>(n)) + rings.size() - 1) /
            rings.size()),
      random_(random),
      places_(random.fork(1000)) {}

bool PoseSearch::Inside::gather(std::size_t most) {
  while (most > 0 && ring_ < rings_.size()) {
    const std::size_t count = std::min(most, each_ - tried_);
    append(set_, someAround(rings_[ring_], count, places_), within_);
    most -= count;
    tried_ += count;
    if (tried_ == each_) endRing();
  }
  return ring_ == rings_.size();
}

void PoseSearch::Inside::endRing() {
  const Ring& ring = rings_[ring_];
  if (set_.size() == had_)
    append(set_, static_cast<float>(ring.pose.x), static_cast<float>(ring.pose.y),
           static_cast<float>(ring.pose.theta));
  volume_ += std::numbers::pi * ring.radius * ring.radius * 2.0 * ring.turn *
             static_cast<double>(set_.size() - had_) / static_cast<double>(each_);
  had_ = set_.size();
  tried_ = 0;
  ++ring_;
  places_ = random_.fork(1000 + ring_);
}

PoseSearch::Drawing PoseSearch::Inside::drawing(const Weigh& weigh) {
  const PoseSearch& all = search_;
  const double floor =
      static_cast<double>(all.cells()) * all.region_.grid.cell * all.region_.grid.cell;
  return {{Annealing(weigh, within_), std::move(set_), n_, random_},
          std::log(volume_ / (floor * 2.0 * std::numbers::pi))};
}

}  // namespace ortung

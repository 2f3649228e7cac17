#include "PoseSearch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "Resampling.hpp"

namespace ortung {
namespace {

PoseSearch::Drawn toTheEnd(PoseSearch::Drawing drawing) {
  while (drawing.draw.work(std::numeric_limits<std::size_t>::max()) > 0) {
  }
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

PoseSearch::PoseSearch(const FieldRegion& region) : region_(region) {
  for (std::size_t cell = 0; cell < region.standable.size(); ++cell) {
    if (region.standable[cell] != 0) standable_.push_back(static_cast<std::uint32_t>(cell));
  }
}

SampleSet PoseSearch::anywhere(std::size_t n, Random random) const {
  SampleSet set;
  set.resize(n);
  const double half = 0.5 * region_.grid.cell;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t cell = standable_[random.below(standable_.size())];
    set.x[i] = static_cast<float>(region_.grid.centreX(cell) + random.uniform(-half, half));
    set.y[i] = static_cast<float>(region_.grid.centreY(cell) + random.uniform(-half, half));
    set.theta[i] = static_cast<float>(random.uniform(-std::numbers::pi, std::numbers::pi));
    set.logWeight[i] = 0.0F;
  }
  return set;
}

SampleSet PoseSearch::around(const Ring& ring, std::size_t n, Random random) {
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
                                   const Random& random, const std::optional<Ring>& ring) const {
  if (!ring) return toTheEnd(drawingBeside({}, n, candidates, weigh, random));
  const auto tried = static_cast<std::size_t>(candidates * static_cast<double>(n));
  return Annealing(weigh, within({&*ring, 1}))
      .draw(around(*ring, tried, random.fork(0)), n, random);
}

PoseSearch::Drawing PoseSearch::drawingBeside(std::span<const Ring> rings, std::size_t n,
                                              double candidates, const Weigh& weigh,
                                              const Random& random) const {
  const auto tried = static_cast<std::size_t>(candidates * static_cast<double>(n));
  const Within beside =
      standable([inRings = within(rings)](float x, float y, float t) { return !inRings(x, y, t); });
  SampleSet set;
  append(set, anywhere(tried, random.fork(0)), beside);
  if (set.size() == 0) return {{Annealing(weigh, beside), {}, 0, random}, 0.0};
  const double share = static_cast<double>(set.size()) / static_cast<double>(tried);
  return {{Annealing(weigh, beside), std::move(set), n, random}, std::log(share)};
}

PoseSearch::Drawn PoseSearch::drawFrom(std::span<const Ring> rings, std::size_t n,
                                       double candidates, const Weigh& weigh,
                                       const Random& random) const {
  return toTheEnd(drawingFrom(rings, n, candidates, weigh, random));
}

PoseSearch::Drawing PoseSearch::drawingFrom(std::span<const Ring> rings, std::size_t n,
                                            double candidates, const Weigh& weigh,
                                            const Random& random) const {
  const auto tried = static_cast<std::size_t>(candidates * static_cast<double>(n));
  const std::size_t each = (tried + rings.size() - 1) / rings.size();
  const Within inRings = standable(within(rings));
  SampleSet set;
  double volume = 0.0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Ring& ring = rings[i];
    const std::size_t before = set.size();
    // These streams of random numbers are beyond those of the annealing.
    append(set, around(ring, each, random.fork(1000 + i)), inRings);
    if (set.size() == before)
      append(set, static_cast<float>(ring.pose.x), static_cast<float>(ring.pose.y),
             static_cast<float>(ring.pose.theta));
    volume += std::numbers::pi * ring.radius * ring.radius * 2.0 * ring.turn *
              static_cast<double>(set.size() - before) / static_cast<double>(each);
  }
  const double floor = static_cast<double>(cells()) * region_.grid.cell * region_.grid.cell;
  return {{Annealing(weigh, inRings), std::move(set), n, random},
          std::log(volume / (floor * 2.0 * std::numbers::pi))};
}

}  // namespace ortung

#include "PoseSearch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Resampling.hpp"

namespace ortung {

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

Annealing::Within PoseSearch::within(std::span<const Ring> rings) {
  return [rings](float x, float y, float theta) {
    return std::any_of(rings.begin(), rings.end(), [&](const Ring& ring) {
      return std::hypot(x - ring.pose.x, y - ring.pose.y) <= ring.radius &&
             std::abs(wrapAngle(theta - ring.pose.theta)) <= ring.turn;
    });
  };
}

PoseSearch::Drawn PoseSearch::draw(std::size_t n, double candidates, const Weigh& weigh,
                                   const Random& random, const std::optional<Ring>& ring) const {
  const auto tried = static_cast<std::size_t>(candidates * static_cast<double>(n));
  if (ring)
    return Annealing(weigh, within({&*ring, 1}))
        .draw(around(*ring, tried, random.fork(0)), n, random);
  const auto isStandable = [&](float x, float y, float) {
    const std::ptrdiff_t cell = region_.grid.cellAt(x, y);
    return cell >= 0 && region_.standable[static_cast<std::size_t>(cell)] != 0;
  };
  return Annealing(weigh, isStandable).draw(anywhere(tried, random.fork(0)), n, random);
}

PoseSearch::Drawn PoseSearch::drawFrom(std::span<const Ring> rings, std::size_t n,
                                       double candidates, const Weigh& weigh,
                                       const Random& random) const {
  const auto tried = static_cast<std::size_t>(candidates * static_cast<double>(n));
  const std::size_t each = (tried + rings.size() - 1) / rings.size();
  SampleSet set;
  double volume = 0.0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    // Streams beyond those of the annealing.
    const SampleSet some = around(rings[i], each, random.fork(1000 + i));
    set.x.insert(set.x.end(), some.x.begin(), some.x.end());
    set.y.insert(set.y.end(), some.y.begin(), some.y.end());
    set.theta.insert(set.theta.end(), some.theta.begin(), some.theta.end());
    volume += std::numbers::pi * rings[i].radius * rings[i].radius * 2.0 * rings[i].turn;
  }
  set.logWeight.assign(set.x.size(), 0.0F);
  Drawn drawn = Annealing(weigh, within(rings)).draw(std::move(set), n, random);
  const double floor = static_cast<double>(cells()) * region_.grid.cell * region_.grid.cell;
  drawn.logEvidence += std::log(volume / (floor * 2.0 * std::numbers::pi));
  return drawn;
}

}  // namespace ortung

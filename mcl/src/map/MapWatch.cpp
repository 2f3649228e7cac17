#include "MapWatch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "MapTuning.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/PoseCovariance.hpp"

namespace ortung {
namespace {

using namespace tuning::map;

constexpr double kFarthest = 1e6;  ///< [m]
constexpr Timestamp kTidy = 1'000'000;
constexpr Timestamp kDay = 86'400'000'000;

using Doubt = MapWatch::Doubt;

Doubt doubtOf(const PoseEstimate& estimate) {
  return {kSigmas * std::sqrt(std::max(estimate.covariance[0], estimate.covariance[4])),
          kSigmas * std::sqrt(headingVariance(estimate.covariance))};
}

/// Ranges that a beam may be expected to have, by those next to it.
struct Expected {
  double least;
  double most;
};

Expected expectedAround(const std::vector<TracedBeam>& beams, std::size_t at, const Doubt& doubt) {
  const TracedBeam& beam = beams[at];
  const double near = std::min(std::isfinite(beam.read) ? beam.read : beam.expected, beam.expected);
  const double reach = kAround + doubt.radians + doubt.metres / std::max(near, kMargin);
  Expected expected{beam.expected, beam.expected};
  const auto take = [&](std::size_t other) {
    expected.least = std::min(expected.least, beams[other].expected);
    expected.most = std::max(expected.most, beams[other].expected);
    return std::abs(beams[other].bearing - beam.bearing) < reach;
  };
  for (std::size_t other = at; other-- > 0 && take(other);) continue;
  for (std::size_t other = at + 1; other < beams.size() && take(other); ++other) continue;
  return expected;
}

MapWatch::Point pointOn(const TracedBeam& beam, double range) {
  return {beam.x + range * std::cos(beam.bearing), beam.y + range * std::sin(beam.bearing)};
}

/// How far a beam is known to go on: no farther than the sensor can tell.
double wayOf(const TracedBeam& beam) { return std::min(beam.read, beam.reach); }

double marginOf(const TracedBeam& beam, const Doubt& doubt) {
  return kMargin + std::hypot(kSigmas * beam.sigma, doubt.metres);
}

bool hasMovedOn(const std::optional<Pose2>& from, const Pose2& to) {
  if (!from) return true;
  const Pose2 change = inverse(*from) * to;
  return std::hypot(change.x, change.y) >= kStep || std::abs(change.theta) >= kStepTurn;
}

std::int64_t dayOf(Timestamp stamp) { return stamp / kDay - (stamp % kDay < 0 ? 1 : 0); }

}  // namespace

std::optional<MapWatch::Key> MapWatch::keyAt(MapChange::Kind kind, const Point& at) {
  if (!(std::abs(at.x) < kFarthest && std::abs(at.y) < kFarthest)) return std::nullopt;
  return Key{kind, MapChanges::numberOf(at.y), MapChanges::numberOf(at.x)};
}

void MapWatch::follow(const std::vector<NewReading>& news, const PoseEstimate& estimate) {
  if (estimate.status != TrackStatus::kTracking) return;
  const Doubt doubt = doubtOf(estimate);
  if (doubt.metres > kSigmas * kMostSigma || doubt.radians > kSigmas * kMostTurn) return;
  std::vector<TracedBeam> beams;
  for (const NewReading& one : news) {
    const auto* traceable = dynamic_cast<const Traceable*>(one.weigher.get());
    std::optional<Pose2>& looked = looked_[one.feature];
    if (traceable == nullptr || !hasMovedOn(looked, estimate.pose)) continue;
    beams.clear();
    traceable->trace(estimate.pose, beams);
    if (beams.empty()) continue;
    look(beams, doubt, estimate.stamp);
    looked = estimate.pose;
  }
  tidy(estimate.stamp);
}

void MapWatch::look(const std::vector<TracedBeam>& beams, const Doubt& doubt, Timestamp stamp) {
  struct Found {
    std::vector<Point> otherwise;
    std::size_t asLearned = 0;
  };
  std::map<Key, Found> found;
  std::size_t odd = 0;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const TracedBeam& beam = beams[i];
    const double margin = marginOf(beam, doubt);
    const Expected expected = expectedAround(beams, i, doubt);
    const bool isLonger = wayOf(beam) > expected.most + margin;
    const bool isShorter = beam.read < expected.least - margin;
    const bool isAsLearned =
        std::isfinite(beam.expected) && std::abs(beam.read - beam.expected) <= margin;
    const bool isOdd = isLonger || isShorter;
    if (isOdd) ++odd;
    const auto add = [&](MapChange::Kind kind, double range, bool isOtherwise) {
      const Point at = pointOn(beam, range);
      const auto key = keyAt(kind, at);
      if (!key) return;
      if (isOtherwise)
        found[*key].otherwise.push_back(at);
      else
        ++found[*key].asLearned;
    };
    if (isLonger || isAsLearned) add(MapChange::Kind::kGone, beam.expected, isLonger);
    if (isOdd && std::isfinite(beam.read) && beam.away > margin)
      add(MapChange::Kind::kNew, beam.read, true);
  }
  if (static_cast<double>(odd) > kMostOdd * static_cast<double>(beams.size())) return;
  // The beams of a scan that meet a cell are one look.
  for (const auto& [key, one] : found)
    note(key, one.otherwise.size() > one.asLearned ? one.otherwise : std::vector<Point>(), stamp);
  lookPastNew(beams, doubt, stamp);
}

/// What was new is gone where beams on both sides go on behind it.
void MapWatch::lookPastNew(const std::vector<TracedBeam>& beams, const Doubt& doubt,
                           Timestamp stamp) {
  const double x = beams.front().x;
  const double y = beams.front().y;
  const double first = beams.front().bearing;
  double reach = 0.0;
  for (const TracedBeam& beam : beams) reach = std::max(reach, wayOf(beam));
  constexpr auto kLeft = std::numeric_limits<std::int32_t>::min();
  const auto low = keyAt(MapChange::Kind::kNew, {x, y - reach});
  const auto high = keyAt(MapChange::Kind::kNew, {x, y + reach});
  if (!low || !high) return;
  const auto end = cells_.lower_bound({high->kind, high->row + 1, kLeft});
  for (auto at = cells_.lower_bound({low->kind, low->row, kLeft}); at != end; ++at) {
    Cell& cell = at->second;
    const double dx = cell.before.x - x;
    const double dy = cell.before.y - y;
    const double away = std::hypot(dx, dy);
    if (away > reach) continue;
    double bearing = first + wrapAngle(std::atan2(dy, dx) - first);
    if (bearing < first) bearing += ortung::kTurn;
    const auto after =
        std::lower_bound(beams.begin(), beams.end(), bearing,
                         [](const TracedBeam& beam, double angle) { return beam.bearing < angle; });
    if (after == beams.begin() || after == beams.end()) continue;
    const TracedBeam& before = *std::prev(after);
    const bool areBeside = (after->bearing - before.bearing) * away < kBeside;
    if (areBeside && std::min(wayOf(*after), wayOf(before)) > away + marginOf(*after, doubt))
      count(cell, false, stamp);
  }
}

/// Counts a look at a cell. @param otherwise what contradicts the map there; empty: nothing does
void MapWatch::note(const Key& key, const std::vector<Point>& otherwise, Timestamp stamp) {
  auto found = cells_.find(key);
  if (found == cells_.end()) {
    if (otherwise.empty() || cells_.size() >= MapChanges::kMost) return;
    found = cells_.try_emplace(key).first;
  }
  Cell& cell = found->second;
  count(cell, !otherwise.empty(), stamp);
  for (const Point& at : otherwise) {
    cell.points = std::min(cell.points + 1.0, kMostPoints);
    cell.before.x += (at.x - cell.before.x) / cell.points;
    cell.before.y += (at.y - cell.before.y) / cell.points;
  }
}

void MapWatch::count(Cell& cell, bool isOtherwise, Timestamp stamp) {
  const bool isInPass = cell.otherwise + cell.asLearned > 0 && stamp >= cell.seen &&
                        toSeconds(stamp - cell.seen) < kGap &&
                        toSeconds(stamp - cell.begun) < kLongest;
  if (!isInPass) {
    endPass(cell);
    cell.begun = stamp;
  }
  cell.seen = stamp;
  ++(isOtherwise ? cell.otherwise : cell.asLearned);
}

MapWatch::Verdict MapWatch::verdictOf(const Cell& cell) {
  const double looks = cell.otherwise + cell.asLearned;
  if (looks < kLooks) return Verdict::kOpen;
  if (cell.otherwise >= kAgree * looks) return Verdict::kOtherwise;
  return cell.asLearned >= kAgree * looks ? Verdict::kAsLearned : Verdict::kOpen;
}

void MapWatch::endPass(Cell& cell) {
  const Verdict verdict = verdictOf(cell);
  if (verdict == Verdict::kOtherwise) {
    ++cell.before.passes;
    ++cell.before.lately;
    const std::int64_t day = dayOf(cell.begun);
    if (cell.before.days == 0 || day != cell.before.lastDay) ++cell.before.days;
    cell.before.lastDay = day;
  } else if (verdict == Verdict::kAsLearned) {
    ++cell.before.against;
    cell.before.lately = 0;
  }
  cell.otherwise = 0;
  cell.asLearned = 0;
}

/// Returns what is known of a cell, as if its pass ended now.
MapChange MapWatch::now(const Key& key, const Cell& cell) {
  Cell ended = cell;
  endPass(ended);
  ended.before.kind = key.kind;
  ended.before.column = key.column;
  ended.before.row = key.row;
  return ended.before;
}

/// Ends passes that are over, and forgets cells of which they say nothing.
void MapWatch::tidy(Timestamp stamp) {
  if (stamp >= tidied_ && stamp - tidied_ < kTidy) return;
  tidied_ = stamp;
  for (auto at = cells_.begin(); at != cells_.end();) {
    Cell& cell = at->second;
    if (toSeconds(stamp - cell.seen) >= kGap || toSeconds(stamp - cell.begun) >= kLongest)
      endPass(cell);
    // It was a person once, or what was changed is as it was.
    const bool isOver = cell.before.lately == 0 && cell.before.against >= cell.before.passes;
    at = cell.otherwise == 0 && isOver ? cells_.erase(at) : std::next(at);
  }
  findSure();
}

/// Finds groups of cells that enough passes in a row have found otherwise.
void MapWatch::findSure() {
  constexpr std::int32_t kReach = 2;  // cells; beams of a far scanner leave gaps
  std::set<Key> open;
  for (const auto& [key, cell] : cells_)
    if (now(key, cell).lately >= kPasses) open.insert(key);
  sure_.clear();
  while (!open.empty()) {
    std::vector<Key> group{*open.begin()};
    open.erase(open.begin());
    for (std::size_t k = 0; k < group.size(); ++k)
      for (std::int32_t row = -kReach; row <= kReach; ++row)
        for (std::int32_t column = -kReach; column <= kReach; ++column) {
          const Key next{group[k].kind, group[k].row + row, group[k].column + column};
          if (open.erase(next) > 0) group.push_back(next);
        }
    if (group.size() >= kTogether) sure_.insert(group.begin(), group.end());
  }
}

bool MapWatch::isSureNear(MapChange::Kind kind, const TracedBeam& beam, double range) const {
  if (!std::isfinite(range)) return false;
  const auto at = keyAt(kind, pointOn(beam, range));
  if (!at) return false;
  for (std::int32_t row = -1; row <= 1; ++row)
    for (std::int32_t column = -1; column <= 1; ++column)
      if (sure_.contains({kind, at->row + row, at->column + column})) return true;
  return false;
}

std::vector<NewReading> MapWatch::withoutChanged(std::vector<NewReading> news,
                                                 const Pose2& pose) const {
  if (sure_.empty()) return news;
  std::vector<TracedBeam> beams;
  for (NewReading& one : news) {
    const auto* traceable = dynamic_cast<const Traceable*>(one.weigher.get());
    if (traceable == nullptr) continue;
    beams.clear();
    traceable->trace(pose, beams);
    std::vector<bool> dropped;
    for (const TracedBeam& beam : beams)
      dropped.push_back(isSureNear(MapChange::Kind::kGone, beam, beam.expected) ||
                        isSureNear(MapChange::Kind::kNew, beam, beam.read));
    const auto count = static_cast<double>(std::count(dropped.begin(), dropped.end(), true));
    if (count == 0.0 || count > kMostOdd * static_cast<double>(beams.size())) continue;
    if (auto rest = traceable->without(dropped)) one.weigher = std::move(rest);
  }
  return news;
}

void MapWatch::forgetPass() {
  for (auto& [key, cell] : cells_) {
    cell.otherwise = 0;
    cell.asLearned = 0;
  }
  looked_.clear();
}

MapChanges MapWatch::changes() const {
  MapChanges changes;
  for (const auto& [key, cell] : cells_) {
    MapChange change = now(key, cell);
    if (change.passes == 0) continue;
    change.isSure = sure_.contains(key);
    changes.cells.push_back(change);
  }
  return changes;
}

void MapWatch::restore(const MapChanges& changes) {
  changes.check();
  cells_.clear();
  for (const MapChange& change : changes.cells) {
    Cell& cell = cells_[{change.kind, change.row, change.column}];
    cell.before = change;
    cell.points = kMostPoints;
  }
  looked_.clear();
  findSure();
}

}  // namespace ortung

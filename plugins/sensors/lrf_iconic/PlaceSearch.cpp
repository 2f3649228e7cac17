#include "PlaceSearch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

/// A point turned by a heading, in cells.
struct TurnedPoint {
  int column = 0;
  int row = 0;
  std::uint32_t bit = 0;
};

/// The poses of a square of cells and a heading.
struct Square {
  int column = 0;
  int row = 0;
  int heading = 0;
  int level = 0;  ///< of the raster
  int bound = 0;  ///< no pose in it has more points at walls
};

int shareOf(double share, int count) {
  return std::max(1, static_cast<int>(std::ceil(share * count)));
}

class Search {
 public:
  Search(const WallRaster& raster, std::span<const OutlinePoint> points,
         const PlaceSearchConfig& config)
      : raster_(raster),
        points_(points),
        config_(config),
        needed_(shareOf(config.least, static_cast<int>(points.size()))) {
    turn();
  }

  FoundPlaces run() {
    constexpr int kTop = WallRaster::kLevels - 1;
    const int side = 1 << kTop;
    for (int heading = 0; heading < headings_; ++heading)
      for (int row = -outside_; row < raster_.rows() + outside_; row += side)
        for (int column = -outside_; column < raster_.columns() + outside_; column += side)
          look({column, row, heading, kTop});
    // The most promising square first, so places come in the order of their points.
    while (!open_.empty() && open_.front().bound >= needed_ && found_.isAll) {
      std::pop_heap(open_.begin(), open_.end(), isWorse);
      const Square square = open_.back();
      open_.pop_back();
      if (square.level == 0)
        add(square);
      else
        divide(square);
    }
    return std::move(found_);
  }

 private:
  void turn() {
    std::vector<double> ranges;
    for (const OutlinePoint& p : points_) ranges.push_back(std::hypot(p.x, p.y));
    std::sort(ranges.begin(), ranges.end());
    const double mean =
        std::accumulate(ranges.begin(), ranges.end(), 0.0) / static_cast<double>(ranges.size());
    // The scanner may stand where there are no walls, e.g. beside two goals, but so many points
    // have to reach them.
    const double reached = ranges[ranges.size() - static_cast<std::size_t>(needed_)];
    outside_ = static_cast<int>(std::ceil(reached / raster_.cell())) + 1;
    const double step = std::clamp(raster_.cell() / std::max(1.5 * mean, 1e-3), 0.005, 0.05);
    headings_ = static_cast<int>(std::ceil(kTurn / step));
    turned_.reserve(static_cast<std::size_t>(headings_) * points_.size());
    for (int heading = 0; heading < headings_; ++heading) {
      const double angle = headingOf(heading);
      const double c = std::cos(angle) / raster_.cell();
      const double s = std::sin(angle) / raster_.cell();
      for (const OutlinePoint& p : points_)
        turned_.push_back({static_cast<int>(std::lround(c * p.x - s * p.y)),
                           static_cast<int>(std::lround(s * p.x + c * p.y)),
                           WallRaster::bitOf(angle + p.direction)});
    }
  }

  double headingOf(int heading) const { return wrapAngle(heading * kTurn / headings_); }

  /// Whether b is to be looked at before a. Of equal ones the smaller, which are nearer to a place.
  static bool isWorse(const Square& a, const Square& b) {
    return std::tuple(a.bound, -a.level, a.heading, a.row, a.column) <
           std::tuple(b.bound, -b.level, b.heading, b.row, b.column);
  }

  /// Finds the bound of a square and keeps it if it may hold what is looked for.
  void look(Square square) {
    if (++looked_ > config_.effort) {
      found_.isAll = false;
      return;
    }
    const auto n = static_cast<int>(points_.size());
    int spare = n - needed_;
    const TurnedPoint* points =
        turned_.data() + static_cast<std::size_t>(square.heading) * points_.size();
    for (int i = 0; i < n; ++i) {
      const TurnedPoint& p = points[i];
      const std::uint32_t directions =
          raster_.directions(square.level, square.column + p.column, square.row + p.row);
      if ((directions & p.bit) == 0 && --spare < 0) return;
    }
    square.bound = needed_ + spare;
    open_.push_back(square);
    std::push_heap(open_.begin(), open_.end(), isWorse);
  }

  void divide(const Square& square) {
    const int half = 1 << (square.level - 1);
    for (int i = 0; i < 4; ++i) {
      const Square quarter{square.column + (i % 2) * half, square.row + (i / 2) * half,
                           square.heading, square.level - 1};
      look(quarter);
    }
  }

  void add(const Square& square) {
    const Pose2 scanner{raster_.originX() + (square.column + 0.5) * raster_.cell(),
                        raster_.originY() + (square.row + 0.5) * raster_.cell(),
                        headingOf(square.heading)};
    const bool isKnown = std::any_of(found_.scanners.begin(), found_.scanners.end(),
                                     [&](const Pose2& known) { return isNear(known, scanner); });
    if (isKnown) return;
    found_.isAll = found_.scanners.size() < config_.most;
    if (!found_.isAll) return;
    needed_ = std::max(needed_, shareOf(config_.alike, square.bound));
    found_.scanners.push_back(scanner);
  }

  bool isNear(const Pose2& a, const Pose2& b) const {
    return distance(a, b) < config_.apart &&
           std::abs(wrapAngle(a.theta - b.theta)) < config_.turned;
  }

  const WallRaster& raster_;
  std::span<const OutlinePoint> points_;
  PlaceSearchConfig config_;
  int needed_;
  int headings_ = 0;
  int outside_ = 0;                  ///< how far from the raster the scanner may be [cells]
  std::vector<TurnedPoint> turned_;  ///< of all headings, one after another
  std::vector<Square> open_;         ///< a heap
  FoundPlaces found_;
  std::size_t looked_ = 0;
};

}  // namespace

FoundPlaces findPlaces(const WallRaster& raster, std::span<const OutlinePoint> points,
                       const PlaceSearchConfig& config) {
  if (points.empty()) return {};
  return Search(raster, points, config).run();
}

}  // namespace ortung

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ortung/base/Angles.hpp"
#include "ortung/vision/FieldLines.hpp"

namespace ortung {
namespace {

constexpr double kMargin = 2.0;    ///< width of the table's margin around the lines [m]
constexpr float kOutside = 10.0F;  ///< distance to a line outside the table [m]
constexpr double kMostCost = 9.0;  ///< greatest cost of a point

bool isBetter(const LinePose& a, const LinePose& b) { return a.cost < b.cost; }

/// Poses that are nearer to each other than this are of one place.
struct Extent {
  double way;   ///< [m]
  double turn;  ///< [rad]
};
constexpr Extent kHill{0.7, 0.25};  ///< of the grid's costs
constexpr Extent kPlace{0.3, 0.1};  ///< where polishing ends

/// The first of each place. @param most that are looked for
std::vector<LinePose> onePerPlace(std::span<const LinePose> poses, const Extent& extent,
                                  std::size_t most) {
  std::vector<LinePose> kept;
  for (const LinePose& one : poses) {
    if (kept.size() >= most) break;
    const bool isKnown = std::any_of(kept.begin(), kept.end(), [&](const LinePose& other) {
      return distance(one.pose, other.pose) < extent.way &&
             std::abs(wrapAngle(one.pose.theta - other.pose.theta)) < extent.turn;
    });
    if (!isKnown) kept.push_back(one);
  }
  return kept;
}

/// The floor of a number that fits into an int, without a call of the mathematical library.
int floorOf(double x) {
  const int whole = static_cast<int>(x);
  return x < whole ? whole - 1 : whole;
}

}  // namespace

/// The cheapest poses that were offered, so many at most.
class LinePoseSearch::Cheapest {
 public:
  explicit Cheapest(std::size_t most) : most_(most) {}
  /// The cost from which on poses are not kept.
  double bound() const {
    return poses_.size() < most_ ? std::numeric_limits<double>::infinity() : poses_.front().cost;
  }
  void offer(const LinePose& pose) {
    if (pose.cost >= bound()) return;
    if (poses_.size() >= most_) {
      std::pop_heap(poses_.begin(), poses_.end(), isBetter);
      poses_.pop_back();
    }
    poses_.push_back(pose);
    std::push_heap(poses_.begin(), poses_.end(), isBetter);
  }
  std::vector<LinePose> sorted() {
    std::sort_heap(poses_.begin(), poses_.end(), isBetter);
    return std::move(poses_);
  }

 private:
  std::size_t most_;
  std::vector<LinePose> poses_;  ///< a heap: the most expensive one comes first
};

LinePoseSearch::LinePoseSearch(const FieldLines& lines) : LinePoseSearch(lines, Config{}) {}

LinePoseSearch::LinePoseSearch(const FieldLines& lines, const Config& config)
    : lines_(lines), config_(config) {
  xMin_ = lines.xMin() - kMargin;
  yMin_ = lines.yMin() - kMargin;
  columns_ = static_cast<int>(std::ceil((lines.xMax() + kMargin - xMin_) / config.cell)) + 1;
  rows_ = static_cast<int>(std::ceil((lines.yMax() + kMargin - yMin_) / config.cell)) + 1;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const double x = xMin_ + column * config.cell;
      const double y = yMin_ + row * config.cell;
      double best = std::numeric_limits<double>::max();
      std::size_t line = 0;
      for (std::size_t i = 0; i < lines_.lines().size(); ++i) {
        const double d = lines_.nearestOn(i, x, y).distance;
        if (d < best) best = d, line = i;
      }
      distances_.push_back(static_cast<float>(best));
      nearest_.push_back(static_cast<std::uint16_t>(line));
    }
}

std::ptrdiff_t LinePoseSearch::cellAt(double x, double y) const {
  const int column = floorOf((x - xMin_) / config_.cell + 0.5);
  const int row = floorOf((y - yMin_) / config_.cell + 0.5);
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return -1;
  return static_cast<std::ptrdiff_t>(row) * columns_ + column;
}

// Compares the lines that are nearest to the cell and to its neighbours two cells away.
FieldLines::Nearest LinePoseSearch::nearest(double x, double y) const {
  const std::ptrdiff_t middle = cellAt(x, y);
  if (middle < 0) return lines_.nearest(x, y);
  std::uint16_t line = nearest_[static_cast<std::size_t>(middle)];
  FieldLines::Nearest best = lines_.nearestOn(line, x, y);
  const double away = 2.0 * config_.cell;
  for (const auto& [dx, dy] : {std::pair{away, 0.0}, {-away, 0.0}, {0.0, away}, {0.0, -away}}) {
    const std::ptrdiff_t cell = cellAt(x + dx, y + dy);
    if (cell < 0 || nearest_[static_cast<std::size_t>(cell)] == line) continue;
    line = nearest_[static_cast<std::size_t>(cell)];
    const FieldLines::Nearest other = lines_.nearestOn(line, x, y);
    if (other.distance < best.distance) best = other;
  }
  return best;
}

double LinePoseSearch::cost(std::span<const LinePlace> points, std::span<const double> sigmas,
                            const Pose2& pose) const {
  const double c = std::cos(pose.theta);
  const double s = std::sin(pose.theta);
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = pose.x + c * points[i].x - s * points[i].y;
    const double y = pose.y + s * points[i].x + c * points[i].y;
    const double r = nearest(x, y).distance / sigmas[i];
    sum += std::min(r * r, kMostCost);
  }
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

LinePoseSearch::Picked LinePoseSearch::pick(std::span<const LinePlace> points,
                                            std::span<const double> sigmas) const {
  Picked picked;
  const std::size_t count = std::min(points.size(), static_cast<std::size_t>(config_.usedPoints));
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k * points.size() / count;
    picked.places.push_back(points[i]);
    const double sigma = std::hypot(sigmas[i], config_.blur);
    picked.weights.push_back(static_cast<float>(1.0 / (sigma * sigma)));
  }
  return picked;
}

void LinePoseSearch::searchHeading(const Picked& picked, double theta, Cheapest& found) const {
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  std::vector<LinePlace> turned;
  for (const LinePlace& p : picked.places) turned.push_back({c * p.x - s * p.y, s * p.x + c * p.y});
  for (double y = lines_.yMin() - config_.beyond; y <= lines_.yMax() + config_.beyond;
       y += config_.step)
    for (double x = lines_.xMin() - config_.beyond; x <= lines_.xMax() + config_.beyond;
         x += config_.step) {
      // Costs are never negative, so a sum that is too large already need not be finished.
      const double bound = found.bound() * static_cast<double>(turned.size());
      float sum = 0.0F;
      for (std::size_t i = 0; i < turned.size() && sum < bound; ++i) {
        const std::ptrdiff_t cell = cellAt(x + turned[i].x, y + turned[i].y);
        const float d = cell < 0 ? kOutside : distances_[static_cast<std::size_t>(cell)];
        sum += std::min(d * d * picked.weights[i], static_cast<float>(kMostCost));
      }
      found.offer({{x, y, theta}, sum / static_cast<double>(turned.size())});
    }
}

std::vector<LinePose> LinePoseSearch::search(std::span<const LinePlace> points,
                                             std::span<const double> sigmas,
                                             std::size_t most) const {
  const Picked picked = pick(points, sigmas);
  if (picked.places.empty()) return {};
  Cheapest found(20 * most);
  const int turns = static_cast<int>(std::ceil(kTurn / config_.turn));
  for (int t = 0; t < turns; ++t) searchHeading(picked, wrapAngle(t * kTurn / turns), found);
  std::vector<LinePose> best;
  for (const LinePose& start : onePerPlace(found.sorted(), kHill, 3 * most))
    best.push_back(polish(points, sigmas, start.pose));
  std::sort(best.begin(), best.end(), isBetter);
  return onePerPlace(best, kPlace, most);
}

LinePose LinePoseSearch::polish(std::span<const LinePlace> points, std::span<const double> sigmas,
                                const Pose2& start) const {
  Pose2 pose = start;
  for (int step = 0; step < 25; ++step) {
    // Sigmas are wide at first, so that distant points attract, and then the points' own.
    const double widen = std::max(1.0, 4.0 * std::pow(0.7, step));
    Eigen::Matrix3d information = Eigen::Matrix3d::Identity() * 1e-6;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    const double c = std::cos(pose.theta);
    const double s = std::sin(pose.theta);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double dx = c * points[i].x - s * points[i].y;
      const double dy = s * points[i].x + c * points[i].y;
      const FieldLines::Nearest n = nearest(pose.x + dx, pose.y + dy);
      if (n.distance < 1e-9) continue;
      const double nx = (pose.x + dx - n.x) / n.distance;
      const double ny = (pose.y + dy - n.y) / n.distance;
      const double r = n.distance / (sigmas[i] * widen);
      // The weight of Geman and McClure: distant points have almost none.
      const double w = 1.0 / ((1.0 + r * r / 4.0) * (1.0 + r * r / 4.0)) / (sigmas[i] * sigmas[i]);
      const Eigen::Vector3d slope(nx, ny, ny * dx - nx * dy);
      information += w * slope * slope.transpose();
      gradient += w * slope * n.distance;
    }
    const Eigen::Vector3d move = -information.ldlt().solve(gradient);
    const double length = std::hypot(move.x(), move.y());
    const double scale =
        std::min({1.0, 0.5 / (length + 1e-12), 0.2 / (std::abs(move.z()) + 1e-12)});
    pose = {pose.x + scale * move.x(), pose.y + scale * move.y(),
            wrapAngle(pose.theta + scale * move.z())};
    if (step > 10 && length < 1e-6 && std::abs(move.z()) < 1e-7) break;
  }
  return {pose, cost(points, sigmas, pose)};
}

}  // namespace ortung

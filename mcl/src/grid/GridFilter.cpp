#include "ortung/mcl/GridFilter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "CarriedOn.hpp"
#include "Confidence.hpp"
#include "Drift.hpp"
#include "GridBelief.hpp"
#include "Intake.hpp"
#include "Kld.hpp"
#include "MotionPieces.hpp"
#include "Resampling.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kLeast = 1e-9;  ///< probability of a bin in which the belief has no share
/// Number of samples for a change of pose: its mean is off by a sixtieth of the noise's sigma.
constexpr std::size_t kDraws = 4096;
/// Memory of a cell while it is weighed: shares twice, pose, logarithms, weight, bin.
constexpr std::size_t kBytesACell = 64;

int turnsOf(const GridConfig& grid) {
  return std::max(4, static_cast<int>(std::lround(kTurn / grid.headingStep)));
}

void checkMemory(const GridConfig& grid, const FieldRegion& region) {
  const std::size_t cells = GridBelief::cellsOf(region.grid, grid.cell, turnsOf(grid));
  if (cells <= grid.mostBytes / kBytesACell) return;
  throw std::invalid_argument(
      "a grid of " + std::to_string(cells) + " poses (cells of " + std::to_string(grid.cell) +
      " m, " + std::to_string(turnsOf(grid)) + " headings) takes about " +
      std::to_string(static_cast<double>(cells) * kBytesACell * 1e-9) + " GB, more than " +
      std::to_string(static_cast<double>(grid.mostBytes) * 1e-9) +
      "; expected larger cells, fewer headings or a smaller field");
}

double square(double value) { return value * value; }

/// Shares of samples and of the grid's cells in the bins that samples are in.
class PlaceBins {
 public:
  explicit PlaceBins(const MclConfig& config)
      : turns_(std::max(1, static_cast<int>(std::lround(kTurn / config.binRadians)))),
        edges_{config.binMetres, config.binMetres, kTurn / turns_} {}

  void addSample(const std::array<float, 3>& pose, double share) {
    Bin bin{};
    for (std::size_t k = 0; k < 3; ++k)
      bin[k] = static_cast<int>(std::floor(static_cast<double>(pose[k]) / edges_[k]));
    bins_[within(bin)].ofSamples += share;
  }
  /// Distributes a cell's share over the bins that it overlaps, in proportion to the overlap.
  void addCell(const Pose2& centre, double cell, double step, double share) {
    const std::array<double, 3> middle = {centre.x, centre.y, centre.theta};
    const std::array<double, 3> halves = {0.5 * cell, 0.5 * cell, 0.5 * step};
    Bin first{};
    Bin last{};
    for (std::size_t k = 0; k < 3; ++k) {
      first[k] = static_cast<int>(std::floor((middle[k] - halves[k]) / edges_[k]));
      last[k] = static_cast<int>(std::floor((middle[k] + halves[k]) / edges_[k]));
    }
    const auto part = [&](std::size_t k, int bin) {
      const double from = std::max(bin * edges_[k], middle[k] - halves[k]);
      const double to = std::min((bin + 1) * edges_[k], middle[k] + halves[k]);
      return std::max(0.0, to - from) / (2.0 * halves[k]);
    };
    for (int x = first[0]; x <= last[0]; ++x)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int turn = first[2]; turn <= last[2]; ++turn) {
          const auto found = bins_.find(within({x, y, turn}));
          if (found != bins_.end())
            found->second.ofCells += share * part(0, x) * part(1, y) * part(2, turn);
        }
  }
  double divergence() const {
    double sum = 0.0;
    for (const auto& [bin, shares] : bins_)
      if (shares.ofSamples > 0.0)
        sum += shares.ofSamples * std::log(shares.ofSamples / std::max(shares.ofCells, kLeast));
    return sum;
  }

 private:
  using Bin = std::array<int, 3>;
  struct Shares {
    double ofSamples = 0.0;
    double ofCells = 0.0;
  };
  Bin within(Bin bin) const {
    bin[2] = ((bin[2] % turns_) + turns_) % turns_;
    return bin;
  }
  int turns_;
  std::array<double, 3> edges_;
  std::map<Bin, Shares> bins_;
};

}  // namespace

void GridConfig::check() const {
  if (!(cell >= 0.01 && cell <= 10.0))
    throw std::invalid_argument("grid: cell is " + std::to_string(cell) +
                                ", must be in [0.01, 10] m");
  if (!(headingStep >= 0.001 && headingStep <= kTurn / 4.0))
    throw std::invalid_argument("grid: heading step is " + std::to_string(headingStep) +
                                ", must be in [0.001, a quarter of a turn] rad");
}

struct GridFilter::Impl {
  MclConfig config;
  FieldRegion region;
  std::unique_ptr<MotionModel> motion;
  Workers workers;
  Intake intake;
  GridBelief belief;
  PoseEstimate estimate;
  mutable std::optional<PoseEstimate> present;  ///< estimate of the present belief
  std::optional<Pose2> lastOdometry;
  std::optional<Timestamp> lastTime;
  std::uint64_t step = 0;
  bool waitsForReading = true;

  Impl(const MclConfig& c, const GridConfig& grid, const FieldRegion& r,
       std::unique_ptr<MotionModel> m)
      : config((c.check(), grid.check(), r.check(), checkMemory(grid, r), c)),
        region(r),
        motion(std::move(m)),
        workers(config.threads),
        intake(config, *motion),
        belief(region.grid, grid.cell, turnsOf(grid)) {}

  void begin() {
    intake.forget();
    lastOdometry.reset();
    lastTime.reset();
    present.reset();
    waitsForReading = true;
    estimate = {};
    estimate.reason = TrackReason::kSearching;
  }
  void predict(const Pose2& odometry) {
    const Pose2 change = lastOdometry ? inverse(*lastOdometry) * odometry : Pose2{};
    const bool isFirst = !lastOdometry;
    lastOdometry = odometry;
    if (isFirst) return;
    const MotionChange its = changeOf(*motion, change, kDraws, config.seed, ++step);
    belief.move(its.mean);
    belief.blur(its.covariance, its.mean.theta);
    present.reset();
  }
  void drift(Timestamp stamp) {
    const double seconds = lastTime ? driftSeconds(*lastTime, stamp) : 0.0;
    if (seconds <= 0.0) return;
    PoseCovariance noise{};
    addVariances(noise, square(config.driftMetres) * seconds,
                 square(config.driftRadians) * seconds);
    belief.blur(noise, 0.0);
  }
  void correct(const std::vector<NewReading>& news, Timestamp stamp) {
    const std::optional<Pose2> odometry = motion->odometryAt(stamp);
    odometry ? predict(*odometry) : drift(stamp);
    belief.weigh([&](const SampleSet& cells, std::vector<float>& out) {
      ortung::weigh(news, cells, &workers, out);
    });
    intake.used(news, stamp, lastOdometry);
    lastTime = stamp;
    waitsForReading = false;
    estimate = estimateNow();
    estimate.stamp = stamp;
    estimate.smooth = estimate.pose;
    present = estimate;
  }
  PoseEstimate estimateNow() const {
    const SampleSet cells = belief.samples();
    if (cells.size() == 0) {  // the whole belief has left the area
      PoseEstimate gone = estimate;
      gone.share = 0.0;
      gone.samples = 0;
      judge(Signs{}, gone);
      return gone;
    }
    PoseEstimate now = estimateOf(config, cells.view(), normalized(cells.logWeight));
    // The variance of a uniform distribution within a cell.
    addVariances(now.covariance, square(belief.cell()) / 12.0, square(belief.headingStep()) / 12.0);
    now.samples = cells.size();
    judge(Signs{}, now);
    return now;
  }
};

GridFilter::GridFilter(const MclConfig& config, const GridConfig& grid, const FieldRegion& region,
                       std::unique_ptr<MotionModel> motion)
    : impl_(std::make_unique<Impl>(config, grid, region, std::move(motion))) {
  startGlobal();
}

GridFilter::~GridFilter() = default;

void GridFilter::startGlobal() {
  Impl& g = *impl_;
  g.begin();
  const FieldRegion& region = g.region;
  const bool any = g.belief.fill([&region](const Pose2& centre) {
    const std::ptrdiff_t cell = region.grid.cellAt(centre.x, centre.y);
    return cell >= 0 && region.standable[static_cast<std::size_t>(cell)] != 0 ? 1.0 : 0.0;
  });
  if (!any)
    throw std::invalid_argument(
        "grid: no centre of a cell is where the robot can stand; expected smaller cells");
}

void GridFilter::startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading) {
  Impl& g = *impl_;
  g.begin();
  const double ofPlace = std::max(sigmaPosition, 0.5 * g.belief.cell());
  const double ofHeading = std::max(sigmaHeading, 0.5 * g.belief.headingStep());
  const bool any = g.belief.fill([&](const Pose2& centre) {
    return std::exp(-0.5 * (square(distance(centre, pose) / ofPlace) +
                            square(wrapAngle(centre.theta - pose.theta) / ofHeading)));
  });
  if (!any) throw std::invalid_argument("grid: the start is off the grid");
}

bool GridFilter::update(const SensorContainer& container) {
  Impl& g = *impl_;
  const Intake::Look look = g.intake.look(container, g.estimate.stamp, true);
  if (look.clockSetTo) {
    g.lastOdometry.reset();
    g.lastTime.reset();
    g.estimate.stamp = *look.clockSetTo;
  }
  for (const auto& [stamp, news] : look.news) g.correct(news, stamp);
  if (!look.news.empty()) return true;
  if (!g.intake.newestOdometry()) return false;
  const auto now = g.motion->odometryAt(*g.intake.newestOdometry());
  if (!now) return false;
  if (!g.lastOdometry || isPiece(inverse(*g.lastOdometry) * *now)) g.predict(*now);
  return false;
}

void GridFilter::followOdometry(const SensorContainer& container) {
  impl_->intake.followOdometry(container);
}

const PoseEstimate& GridFilter::estimate() const { return impl_->estimate; }
bool GridFilter::hasOdometry() const { return impl_->intake.newestOdometry().has_value(); }
SampleSet GridFilter::cells() const { return impl_->belief.samples(); }

std::optional<PoseEstimate> GridFilter::estimate(Timestamp stamp) const {
  const Impl& g = *impl_;
  if (g.waitsForReading) return std::nullopt;
  if (!g.present) g.present = g.estimateNow();
  PoseEstimate then = *g.present;
  const std::optional<Pose2> odometry = g.motion->odometryAt(stamp);
  if (odometry && g.lastOdometry)
    then = carriedOn(then, *g.motion, inverse(*g.lastOdometry) * *odometry, g.config.seed, g.step);
  then.stamp = stamp;
  then.smooth = then.pose;
  judge(Signs{}, then);
  return then;
}

double GridFilter::divergenceOf(const SampleSet& samples) const {
  PlaceBins bins(impl_->config);
  const std::vector<double> weights = normalized(samples.logWeight);
  for (std::size_t i = 0; i < samples.size(); ++i)
    bins.addSample({samples.x[i], samples.y[i], samples.theta[i]}, weights[i]);
  const GridBelief& belief = impl_->belief;
  belief.forEach([&](const Pose2& centre, double share) {
    bins.addCell(centre, belief.cell(), belief.headingStep(), share);
  });
  return bins.divergence();
}

}  // namespace ortung

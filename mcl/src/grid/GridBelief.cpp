#include "GridBelief.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace ortung {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr float kLittle = 1e-9F;  ///< share below which a cell counts as empty
/// Variance of one step to neighbours, in squares of their distance: with a third the fourth moment
/// is that of a normal distribution, too.
constexpr double kMostVariance = 1.0 / 3.0;
constexpr int kMostSteps = 300;  ///< greatest number of steps of a blur: ten cells or headings

int countOf(double length, double cell) {
  return std::max(1, static_cast<int>(std::ceil(length / cell - 1e-9)));
}

}  // namespace

GridBelief::GridBelief(const FieldGrid& area, double cell, int turns)
    : area_(area),
      cell_(cell),
      turns_(turns),
      step_(kTurn / turns),
      columns_(countOf(area.columns * area.cell, cell)),
      rows_(countOf(area.rows * area.cell, cell)),
      offsets_(static_cast<std::size_t>(turns)),
      shares_(layerSize() * static_cast<std::size_t>(turns)),
      buffer_(shares_.size()),
      isFilled_(static_cast<std::size_t>(turns)),
      box_{0, rows_, 0, columns_} {}

std::size_t GridBelief::cellsOf(const FieldGrid& area, double cell, int turns) {
  return static_cast<std::size_t>(countOf(area.columns * area.cell, cell)) *
         static_cast<std::size_t>(countOf(area.rows * area.cell, cell)) *
         static_cast<std::size_t>(turns);
}

double GridBelief::headingOf(int turn) const {
  return wrapAngle((turn + 0.5) * step_ + turnOffset_);
}

template <class Grid, class Visit>
void GridBelief::forEachRow(Grid& grid, const Visit& visit) {
  for (int turn = 0; turn < grid.turns_; ++turn) {
    if (grid.isFilled_[static_cast<std::size_t>(turn)] == 0) continue;
    for (int row = grid.box_.firstRow; row < grid.box_.firstRow + grid.box_.rows; ++row) {
      auto* begin = grid.shares_.data() + grid.placeOf(turn, row, grid.box_.firstColumn);
      visit(turn, row, std::span(begin, static_cast<std::size_t>(grid.box_.columns)));
    }
  }
}

void GridBelief::forEach(const std::function<void(const Pose2&, double)>& visit) const {
  forEachRow(*this, [&](int turn, int row, std::span<const float> shares) {
    const Offset& offset = offsets_[static_cast<std::size_t>(turn)];
    Pose2 centre{0.0, area_.originY + (row + 0.5) * cell_ + offset.y, headingOf(turn)};
    double column = box_.firstColumn + 0.5;
    for (const float share : shares) {
      centre.x = area_.originX + column++ * cell_ + offset.x;
      if (share > 0.0F) visit(centre, static_cast<double>(share));
    }
  });
}

bool GridBelief::fill(const std::function<double(const Pose2&)>& shareAt) {
  std::fill(offsets_.begin(), offsets_.end(), Offset{});
  turnOffset_ = 0.0;
  box_ = {0, rows_, 0, columns_};
  std::fill(isFilled_.begin(), isFilled_.end(), std::uint8_t{1});
  double sum = 0.0;
  forEachRow(*this, [&](int turn, int row, std::span<float> shares) {
    double column = 0.5;
    for (float& share : shares) {
      const double its = shareAt(
          {area_.originX + column++ * cell_, area_.originY + (row + 0.5) * cell_, headingOf(turn)});
      share = static_cast<float>(its);
      sum += its;
    }
  });
  normalize();
  return sum > 0.0;
}

SampleSet GridBelief::samples() const {
  SampleSet set;
  forEach([&](const Pose2& pose, double share) {
    set.x.push_back(static_cast<float>(pose.x));
    set.y.push_back(static_cast<float>(pose.y));
    set.theta.push_back(static_cast<float>(pose.theta));
    set.logWeight.push_back(std::log(static_cast<float>(share)));
  });
  return set;
}

void GridBelief::weigh(
    const std::function<void(const SampleSet& cells, std::vector<float>& out)>& logOf) {
  const SampleSet set = samples();
  if (set.size() == 0) return;
  std::vector<float> values(set.size());
  logOf(set, values);
  for (std::size_t i = 0; i < set.size(); ++i) values[i] += set.logWeight[i];
  const float best = *std::max_element(values.begin(), values.end());
  std::size_t next = 0;
  forEachRow(*this, [&](int, int, std::span<float> shares) {
    for (float& share : shares)
      if (share > 0.0F) share = std::exp(values[next++] - best);
  });
  normalize();
}

/// Scales the shares to sum 1, sets very small ones to zero, and finds the bounding box and the
/// filled layers of the rest.
void GridBelief::normalize() {
  double sum = 0.0;
  forEachRow(*this, [&sum](int, int, std::span<const float> shares) {
    for (const float share : shares) sum += static_cast<double>(share);
  });
  const float factor = sum > 0.0 ? static_cast<float>(1.0 / sum) : 0.0F;
  Box found{rows_, 0, columns_, 0};  // its numbers of rows and columns are ends at first
  std::vector<std::uint8_t> filled(isFilled_.size());
  forEachRow(*this, [&](int turn, int row, std::span<float> shares) {
    int column = box_.firstColumn;
    for (float& share : shares) {
      share *= factor;
      if (share < kLittle) share = 0.0F;
      if (share > 0.0F) {
        found.firstRow = std::min(found.firstRow, row);
        found.rows = std::max(found.rows, row + 1);
        found.firstColumn = std::min(found.firstColumn, column);
        found.columns = std::max(found.columns, column + 1);
        filled[static_cast<std::size_t>(turn)] = 1;
      }
      ++column;
    }
  });
  isFilled_ = std::move(filled);
  box_ = {found.firstRow, std::max(0, found.rows - found.firstRow), found.firstColumn,
          std::max(0, found.columns - found.firstColumn)};
}

/// Makes the result of an operation in the buffer the new shares; the buffer is zero again.
/// @param grownBy number of cells by which the shares may have spread
/// @param filled whether each layer has any share now
void GridBelief::take(int grownBy, std::vector<std::uint8_t> filled) {
  forEachRow(*this, [](int, int, std::span<float> shares) {
    std::fill(shares.begin(), shares.end(), 0.0F);
  });
  shares_.swap(buffer_);
  isFilled_ = std::move(filled);
  grow(grownBy);
}

void GridBelief::grow(int by) {
  const int lastRow = std::min(rows_, box_.firstRow + box_.rows + by);
  const int lastColumn = std::min(columns_, box_.firstColumn + box_.columns + by);
  box_.firstRow = std::max(0, box_.firstRow - by);
  box_.firstColumn = std::max(0, box_.firstColumn - by);
  box_.rows = lastRow - box_.firstRow;
  box_.columns = lastColumn - box_.firstColumn;
}

void GridBelief::move(const Pose2& change) {
  for (int turn = 0; turn < turns_; ++turn) {
    Offset& offset = offsets_[static_cast<std::size_t>(turn)];
    const Pose2 come = Pose2{offset.x, offset.y, headingOf(turn)} * change;
    const double right = std::round(come.x / cell_);
    const double up = std::round(come.y / cell_);
    offset = {come.x - right * cell_, come.y - up * cell_};
    if (isFilled_[static_cast<std::size_t>(turn)] != 0)
      addShifted(layer(shares_, turn), right, up, 1.0F, layer(buffer_, turn));
  }
  take(static_cast<int>(std::hypot(change.x, change.y) / cell_) + 2, isFilled_);
  const double turned = turnOffset_ + change.theta;
  const int steps = static_cast<int>(std::lround(turned / step_));
  turnOffset_ = turned - steps * step_;
  const int first = ((-steps) % turns_ + turns_) % turns_;  // becomes layer 0
  std::rotate(offsets_.begin(), offsets_.begin() + first, offsets_.end());
  std::rotate(isFilled_.begin(), isFilled_.begin() + first, isFilled_.end());
  firstLayer_ = (firstLayer_ + first) % turns_;
}

/// Adds a layer, shifted by a number of cells; bilinear interpolation distributes each share.
void GridBelief::addShifted(const float* from, double right, double up, float share,
                            float* to) const {
  const int left = static_cast<int>(std::floor(right));
  const int down = static_cast<int>(std::floor(up));
  const auto partRight = static_cast<float>(right - left);
  const auto partUp = static_cast<float>(up - down);
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = left + (corner & 1);
    const int dy = down + (corner >> 1);
    const float part = share * ((corner & 1) != 0 ? partRight : 1.0F - partRight) *
                       ((corner >> 1) != 0 ? partUp : 1.0F - partUp);
    if (part == 0.0F) continue;
    const int firstColumn = std::max(box_.firstColumn, -dx);
    const int endColumn = std::min(box_.firstColumn + box_.columns, columns_ - dx);
    const int firstRow = std::max(box_.firstRow, -dy);
    const int endRow = std::min(box_.firstRow + box_.rows, rows_ - dy);
    for (int row = firstRow; row < endRow; ++row) {
      const float* in = from + static_cast<std::ptrdiff_t>(row) * columns_;
      float* out = to + static_cast<std::ptrdiff_t>(row + dy) * columns_ + dx;
      for (int column = firstColumn; column < endColumn; ++column) out[column] += part * in[column];
    }
  }
}

/// Spreads shares to the headings on either side. As noise in heading may be correlated with noise
/// in position, they are also shifted in position.
/// @param share share that goes to each side
/// @param aside shift that goes with a turn to the left by one step, in the frame of the robot
///   before @p turn [m]
void GridBelief::turnAbout(float share, const Offset& aside, double turn) {
  std::vector<std::uint8_t> filled(isFilled_.size());
  for (int from = 0; from < turns_; ++from) {
    if (isFilled_[static_cast<std::size_t>(from)] == 0) continue;
    const Offset& its = offsets_[static_cast<std::size_t>(from)];
    const Pose2 moved = Pose2{0.0, 0.0, headingOf(from) - turn} * Pose2{aside.x, aside.y, 0.0};
    for (const int step : {-1, 0, 1}) {
      const int to = (from + step + turns_) % turns_;
      const Offset& there = offsets_[static_cast<std::size_t>(to)];
      addShifted(layer(shares_, from), (its.x - there.x + step * moved.x) / cell_,
                 (its.y - there.y + step * moved.y) / cell_,
                 step == 0 ? 1.0F - 2.0F * share : share, layer(buffer_, to));
      filled[static_cast<std::size_t>(to)] = 1;
    }
  }
  take(static_cast<int>(std::hypot(aside.x, aside.y) / cell_) + 2, std::move(filled));
}

/// Spreads shares to the neighbours on either side in one direction.
void GridBelief::spread(int right, int up, const std::vector<float>& shareOfLayer) {
  for (int turn = 0; turn < turns_; ++turn) {
    if (isFilled_[static_cast<std::size_t>(turn)] == 0) continue;
    const float share = shareOfLayer[static_cast<std::size_t>(turn)];
    for (const int step : {-1, 0, 1})
      addShifted(layer(shares_, turn), step * right, step * up,
                 step == 0 ? 1.0F - 2.0F * share : share, layer(buffer_, turn));
  }
  take(1, isFilled_);
}

/// The noise is added in steps no larger than the distance of neighbours. The noise in position
/// given the heading (its conditional covariance) is split into steps along x, y and a diagonal. If
/// its ellipse is longer and more slanted than these steps can represent, it is widened along its
/// short axis.
void GridBelief::blur(const PoseCovariance& covariance, double turn) {
  const double ofTurn = headingVariance(covariance);
  const double place = std::max(positionVariance(covariance), 0.0);
  const double neighbours = std::max(ofTurn / (step_ * step_), place / (cell_ * cell_));
  const int steps = static_cast<int>(
      std::clamp(std::ceil(neighbours / kMostVariance), 1.0, static_cast<double>(kMostSteps)));
  const bool turns = ofTurn > 0.0;
  const double alongX = turns ? covariance[2] / ofTurn : 0.0;
  const double alongY = turns ? covariance[5] / ofTurn : 0.0;
  const double xx = covariance[0] - alongX * alongX * ofTurn;
  const double xy = covariance[1] - alongX * alongY * ofTurn;
  const double yy = covariance[4] - alongY * alongY * ofTurn;
  const auto layers = static_cast<std::size_t>(turns_);
  std::vector<float> ofX(layers), ofY(layers), ofRising(layers), ofFalling(layers);
  for (std::size_t t = 0; t < layers; ++t) {
    const double heading = headingOf(static_cast<int>(t)) - turn;
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    const double slant = c * s * (xx - yy) + (c * c - s * s) * xy;
    const auto shareOf = [&](double variance) {
      return static_cast<float>(std::clamp(variance / (2.0 * steps * cell_ * cell_), 0.0, 0.5));
    };
    ofX[t] = shareOf(c * c * xx - 2.0 * c * s * xy + s * s * yy - std::abs(slant));
    ofY[t] = shareOf(s * s * xx + 2.0 * c * s * xy + c * c * yy - std::abs(slant));
    ofRising[t] = shareOf(slant);
    ofFalling[t] = shareOf(-slant);
  }
  for (int step = 0; step < steps; ++step) {
    if (turns)
      turnAbout(static_cast<float>(std::min(0.5, ofTurn / (2.0 * steps * step_ * step_))),
                {alongX * step_, alongY * step_}, turn);
    spread(1, 0, ofX);
    spread(0, 1, ofY);
    spread(1, 1, ofRising);
    spread(1, -1, ofFalling);
  }
  normalize();
}

}  // namespace ortung

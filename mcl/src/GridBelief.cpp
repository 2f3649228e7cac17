#include "GridBelief.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ortung {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr float kLittle = 1e-9F;  ///< of the whole, is taken for nothing
/// Variance of one step to neighbours, in squares of their distance: with a third the fourth moment
/// is that of a normal distribution, too.
constexpr double kMostVariance = 1.0 / 3.0;
constexpr int kMostSteps = 1000;

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

void GridBelief::forEach(const std::function<void(const Pose2&, double)>& visit) const {
  for (int turn = 0; turn < turns_; ++turn) {
    const auto t = static_cast<std::size_t>(turn);
    if (isFilled_[t] == 0) continue;
    for (int row = box_.firstRow; row < box_.firstRow + box_.rows; ++row) {
      const float* shares = shares_.data() + t * layerSize() +
                            static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
      const double y = area_.originY + (row + 0.5) * cell_ + offsets_[t].y;
      for (int column = box_.firstColumn; column < box_.firstColumn + box_.columns; ++column) {
        if (shares[column] > 0.0F)
          visit({area_.originX + (column + 0.5) * cell_ + offsets_[t].x, y, headingOf(turn)},
                static_cast<double>(shares[column]));
      }
    }
  }
}

bool GridBelief::fill(const std::function<double(const Pose2&)>& shareAt) {
  std::fill(offsets_.begin(), offsets_.end(), Offset{});
  turnOffset_ = 0.0;
  box_ = {0, rows_, 0, columns_};
  std::fill(isFilled_.begin(), isFilled_.end(), std::uint8_t{1});
  double sum = 0.0;
  std::size_t i = 0;
  for (int turn = 0; turn < turns_; ++turn)
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column, ++i) {
        const double share = shareAt({area_.originX + (column + 0.5) * cell_,
                                      area_.originY + (row + 0.5) * cell_, headingOf(turn)});
        shares_[i] = static_cast<float>(share);
        sum += share;
      }
  normalize();
  tighten();
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
  for (int turn = 0; turn < turns_; ++turn) {
    if (isFilled_[static_cast<std::size_t>(turn)] == 0) continue;
    float* shares = layer(shares_, turn);
    for (std::size_t i = 0; i < layerSize(); ++i)
      if (shares[i] > 0.0F) shares[i] = std::exp(values[next++] - best);
  }
  normalize();
  tighten();
}

/// Scales shares to sum 1, without what is little.
void GridBelief::normalize() {
  double sum = 0.0;
  for (const float share : shares_) sum += static_cast<double>(share);
  if (!(sum > 0.0)) return;
  const auto factor = static_cast<float>(1.0 / sum);
  for (float& share : shares_) {
    share *= factor;
    if (share < kLittle) share = 0.0F;
  }
}

/// Finds the box and the layers that have anything.
void GridBelief::tighten() {
  Box found{rows_, 0, columns_, 0};  // with ends in place of lengths
  for (int turn = 0; turn < turns_; ++turn) {
    const float* shares = layer(shares_, turn);
    bool any = false;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (!(*shares++ > 0.0F)) continue;
        any = true;
        found.firstRow = std::min(found.firstRow, row);
        found.rows = std::max(found.rows, row + 1);
        found.firstColumn = std::min(found.firstColumn, column);
        found.columns = std::max(found.columns, column + 1);
      }
    }
    isFilled_[static_cast<std::size_t>(turn)] = any ? 1 : 0;
  }
  box_ = {found.firstRow, std::max(0, found.rows - found.firstRow), found.firstColumn,
          std::max(0, found.columns - found.firstColumn)};
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
  std::fill(buffer_.begin(), buffer_.end(), 0.0F);
  for (int turn = 0; turn < turns_; ++turn) {
    Offset& offset = offsets_[static_cast<std::size_t>(turn)];
    const Pose2 come = Pose2{offset.x, offset.y, headingOf(turn)} * change;
    const double right = std::round(come.x / cell_);
    const double up = std::round(come.y / cell_);
    offset = {come.x - right * cell_, come.y - up * cell_};
    if (isFilled_[static_cast<std::size_t>(turn)] != 0)
      addShifted(layer(shares_, turn), right, up, 1.0F, layer(buffer_, turn));
  }
  shares_.swap(buffer_);
  grow(static_cast<int>(std::hypot(change.x, change.y) / cell_) + 2);
  const double turned = turnOffset_ + change.theta;
  const int steps = static_cast<int>(std::lround(turned / step_));
  turnOffset_ = turned - steps * step_;
  const int first = ((-steps) % turns_ + turns_) % turns_;  // becomes layer 0
  const auto rotate = [&](auto& all, std::size_t each) {
    std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(each) * first, all.end());
  };
  rotate(shares_, layerSize());
  rotate(offsets_, 1);
  rotate(isFilled_, 1);
}

/// Adds a layer moved by so many cells, shared out between those that it covers.
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

/// Shares go to the headings on either side. Where noise of the turn goes with one of the place,
/// they are moved by what that turn stands for.
/// @param aside of a turn to the left by one step, in the frame of the robot before @p turn [m]
void GridBelief::turnAbout(float share, const Offset& aside, double turn) {
  std::fill(buffer_.begin(), buffer_.end(), 0.0F);
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
  shares_.swap(buffer_);
  isFilled_ = std::move(filled);
  grow(static_cast<int>(std::hypot(aside.x, aside.y) / cell_) + 2);
}

/// Shares go to the neighbours on either side in one direction.
void GridBelief::spread(int right, int up, const std::vector<float>& shareOfLayer) {
  std::fill(buffer_.begin(), buffer_.end(), 0.0F);
  for (int turn = 0; turn < turns_; ++turn) {
    if (isFilled_[static_cast<std::size_t>(turn)] == 0) continue;
    const float share = shareOfLayer[static_cast<std::size_t>(turn)];
    for (const int step : {-1, 0, 1})
      addShifted(layer(shares_, turn), step * right, step * up,
                 step == 0 ? 1.0F - 2.0F * share : share, layer(buffer_, turn));
  }
  shares_.swap(buffer_);
  grow(1);
}

/// In steps, each no larger than neighbours are. Noise of a place is what the turn leaves open of
/// it (the conditional covariance), split into steps along x, y and a diagonal that have it; where
/// it is longer and more slanting than these can have, what is too narrow is widened.
void GridBelief::blur(const std::array<double, 9>& covariance, double turn) {
  const double ofTurn = covariance[8];
  const double place = std::max(covariance[0] + covariance[4], 0.0);
  const int steps = std::clamp(
      static_cast<int>(
          std::ceil(std::max(ofTurn / (step_ * step_), place / (cell_ * cell_)) / kMostVariance)),
      1, kMostSteps);
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
  tighten();
}

}  // namespace ortung

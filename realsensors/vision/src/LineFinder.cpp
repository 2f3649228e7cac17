#include "ortung/vision/LineFinder.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

/// Width beside a crossing that must mostly be floor, as a share of the crossing's width.
constexpr double kFloorBeside = 0.5;
constexpr int kLeastBeside = 3;      ///< least such width [px]
constexpr int kMostBeside = 12;      ///< greatest such width [px]
constexpr double kFloorShare = 0.7;  ///< least share of floor pixels in it
constexpr int kRough = 60;           ///< floor pixels before a crossing that give its sigma
constexpr double kRougher = 3.0;     ///< least rise of whiteness / the floor's sigma
constexpr int kEdge = 2;             ///< pixels between floor and white that are neither

constexpr double kReach = 4.0;  ///< greatest distance of a point's neighbours [spacings]
constexpr int kNeighbours = 3;  ///< least number of neighbours in line with a point

/// Whether enough neighbours lie on one line through a point. @param around places relative to it
bool isInChain(std::span<const Pixel> around, double spacing) {
  for (const Pixel& end : around) {
    const double length = std::hypot(end.u, end.v);
    int aligned = 0;
    for (const Pixel& other : around)
      aligned +=
          std::abs(end.u * other.v - end.v * other.u) <= std::max(1.2, 0.25 * spacing) * length ? 1
                                                                                                : 0;
    if (aligned >= kNeighbours) return true;
  }
  return false;
}

}  // namespace

std::span<const LinePoint> LineFinder::find(const ImageView& image, const ColourTable& colours) {
  points_.clear();
  if (image.format != PixelFormat::kRgb) return points_;
  const int width = image.size.width;
  const int height = image.size.height;
  const auto pitch = static_cast<std::size_t>(width) * 3;
  longest_ = std::max(4, static_cast<int>(config_.mostWidth * std::max(width, height)));
  for (int v = config_.spacing / 2; v < height; v += config_.spacing) {
    scan(image.pixels + static_cast<std::size_t>(v) * pitch, 3, width, colours);
    for (const Crossing& c : crossings_)
      points_.push_back({{c.middle, static_cast<double>(v)}, c.width, true});
  }
  for (int u = config_.spacing / 2; u < width; u += config_.spacing) {
    scan(image.pixels + static_cast<std::size_t>(u) * 3, pitch, height, colours);
    for (const Crossing& c : crossings_)
      points_.push_back({{static_cast<double>(u), c.middle}, c.width, false});
  }
  keepChains(width, height);
  return points_;
}

/// Keeps points in line with others: the scan lines beside one that crosses a line cross it, too.
void LineFinder::keepChains(int width, int height) {
  const double reach = kReach * config_.spacing;
  const int columns = static_cast<int>(width / reach) + 1;
  const int rows = static_cast<int>(height / reach) + 1;
  const auto cellOf = [&](const Pixel& p) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(p.v / reach), 0, rows - 1) *
                                        columns +
                                    std::clamp(static_cast<int>(p.u / reach), 0, columns - 1));
  };
  cells_.assign(static_cast<std::size_t>(columns * rows) + 1, 0);
  for (const LinePoint& p : points_) ++cells_[cellOf(p.pixel) + 1];
  for (std::size_t i = 1; i < cells_.size(); ++i) cells_[i] += cells_[i - 1];
  sorted_.resize(points_.size());
  next_.assign(cells_.begin(), cells_.end() - 1);
  for (const LinePoint& p : points_)
    sorted_[static_cast<std::size_t>(next_[cellOf(p.pixel)]++)] = p;
  points_.clear();
  for (const LinePoint& p : sorted_) {
    neighbours_.clear();
    const int column = static_cast<int>(p.pixel.u / reach);
    const int row = static_cast<int>(p.pixel.v / reach);
    for (int r = std::max(0, row - 1); r <= std::min(rows - 1, row + 1); ++r) {
      const auto first = static_cast<std::size_t>(r * columns + std::max(0, column - 1));
      const auto last = static_cast<std::size_t>(r * columns + std::min(columns - 1, column + 1));
      for (auto i = static_cast<std::size_t>(cells_[first]);
           i < static_cast<std::size_t>(cells_[last + 1]); ++i) {
        const double du = sorted_[i].pixel.u - p.pixel.u;
        const double dv = sorted_[i].pixel.v - p.pixel.v;
        if (du * du + dv * dv <= reach * reach && (du != 0.0 || dv != 0.0))
          neighbours_.push_back({du, dv});
      }
    }
    if (isInChain(neighbours_, config_.spacing)) points_.push_back(p);
  }
}

void LineFinder::readProfile(const std::uint8_t* first, std::size_t step, int count,
                             const ColourTable& colours) {
  const auto n = static_cast<std::size_t>(count);
  white_.resize(n);
  floorSum_.resize(n + 1);
  whiteSum_.resize(n + 1);
  squareSum_.resize(n + 1);
  floorSum_[0] = whiteSum_[0] = squareSum_[0] = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint8_t* p = first + i * step;
    white_[i] = std::min({p[0], p[1], p[2]});
    const bool isFloor = colours.isFloor(p);
    floorSum_[i + 1] = floorSum_[i] + (isFloor ? 1 : 0);
    whiteSum_[i + 1] = whiteSum_[i] + (isFloor ? white_[i] : 0);
    squareSum_[i + 1] = squareSum_[i] + (isFloor ? white_[i] * white_[i] : 0);
  }
}

/// Finds the crossings along one scan line.
void LineFinder::scan(const std::uint8_t* first, std::size_t step, int count,
                      const ColourTable& colours) {
  crossings_.clear();
  readProfile(first, step, count, colours);
  const auto floorIn = [&](int from, int to) {
    return floorSum_[static_cast<std::size_t>(to)] - floorSum_[static_cast<std::size_t>(from)];
  };
  const auto whiteOfFloor = [&](int from, int to) {
    const int floor = floorIn(from, to);
    return floor > 0 ? static_cast<double>(whiteSum_[static_cast<std::size_t>(to)] -
                                           whiteSum_[static_cast<std::size_t>(from)]) /
                           floor
                     : -1.0;
  };
  const auto white = [&](int i) {
    return static_cast<double>(white_[static_cast<std::size_t>(i)]);
  };
  const auto roughness = [&](int from, int to) {
    const int floor = floorIn(from, to);
    if (floor < 2) return 0.0;
    const double mean = whiteOfFloor(from, to);
    const double squares = static_cast<double>(squareSum_[static_cast<std::size_t>(to)] -
                                               squareSum_[static_cast<std::size_t>(from)]);
    return std::sqrt(std::max(0.0, squares / floor - mean * mean));
  };
  double rough = 0.0;
  const auto threshold = [&](double floor) {
    return floor +
           std::max({rough, static_cast<double>(config_.minStep), config_.minContrast * floor});
  };
  for (int i = kLeastBeside + kEdge; i < count - 1; ++i) {
    // Whiteness must rise from that of the floor just before.
    const int before = std::max(0, i - kMostBeside);
    if (floorIn(std::max(0, i - kLeastBeside - kEdge), i) < kLeastBeside) continue;
    const double left = whiteOfFloor(before, i);
    if (!(white(i) > left + config_.minStep)) continue;
    rough = kRougher * roughness(std::max(0, i - kRough), i - kEdge);
    const double level = threshold(left);
    if (!(white(i) > level)) continue;
    int end = i + 1;
    double peak = white(i);
    while (end < count && white(end) > level && end - i <= longest_) {
      peak = std::max(peak, white(end));
      ++end;
    }
    const int length = end - i;
    const int beside =
        std::clamp(static_cast<int>(kFloorBeside * length), kLeastBeside, kMostBeside);
    const int from = i - kEdge - beside;
    const int to = end + kEdge + beside;
    if (length > longest_ || from < 0 || to > count) continue;
    const double right = whiteOfFloor(end, to);
    const bool hasFloor =
        floorIn(from, i) >= kFloorShare * beside && floorIn(end, to) >= kFloorShare * beside;
    if (hasFloor && peak > threshold(right)) {
      // Edges are where half the rise is reached, between two pixels.
      const double halfLeft = 0.5 * (left + peak);
      const double halfRight = 0.5 * (right + peak);
      int a = i;
      while (a < end - 1 && white(a) < halfLeft) ++a;
      int b = end - 1;
      while (b > a && white(b) < halfRight) --b;
      const auto part = [](double low, double high, double half) {
        return high > low ? std::clamp((high - half) / (high - low), 0.0, 1.0) : 0.0;
      };
      const double rise = a - part(white(a - 1), white(a), halfLeft);
      const double fall = b + part(b + 1 < count ? white(b + 1) : 0.0, white(b), halfRight);
      crossings_.push_back({0.5 * (rise + fall), fall - rise});
    }
    i = end;
  }
}

}  // namespace ortung

#include "ortung/vision/LineFinder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "FaintLines.hpp"
#include "FaintScan.hpp"

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

/// A scan line: how white its pixels are, and sums up to each pixel of those that are floor.
struct Profile {
  std::span<const std::uint8_t> whiteness;
  std::span<const std::int32_t> floorSum;
  std::span<const std::int32_t> whiteSum;
  std::span<const std::int32_t> squareSum;

  int count() const { return static_cast<int>(whiteness.size()); }
  double white(int i) const { return whiteness[static_cast<std::size_t>(i)]; }
  int floorIn(int from, int to) const { return sumOf(floorSum, from, to); }
  /// The mean. @pre there is floor
  double whiteOfFloor(int from, int to) const {
    return static_cast<double>(sumOf(whiteSum, from, to)) / floorIn(from, to);
  }
  /// The floor's standard deviation; 0: there is too little of it.
  double roughness(int from, int to) const {
    const int floor = floorIn(from, to);
    if (floor < 2) return 0.0;
    const double mean = whiteOfFloor(from, to);
    const double squares = static_cast<double>(sumOf(squareSum, from, to));
    return std::sqrt(std::max(0.0, squares / floor - mean * mean));
  }

 private:
  static std::int32_t sumOf(std::span<const std::int32_t> sum, int from, int to) {
    return sum[static_cast<std::size_t>(to)] - sum[static_cast<std::size_t>(from)];
  }
};

/// Pixels in a row that are whiter than the floor before them.
struct Stretch {
  int begin;
  int end;       ///< the first pixel that is not white any more
  double left;   ///< whiteness of the floor before it
  double rough;  ///< by how much that is whiter than its mean now and then
  double peak;   ///< whiteness
  int length() const { return end - begin; }
};

/// From which whiteness on something is no floor.
double threshold(double floor, double rough, const LineFinder::Config& config) {
  return floor + std::max({rough, static_cast<double>(config.minStep), config.minContrast * floor});
}

/// What rises from the floor at @p i; nothing if there is no floor before it, or no rise.
std::optional<Stretch> whiteFrom(int i, const Profile& profile, const LineFinder::Config& config,
                                 int longest) {
  if (profile.floorIn(std::max(0, i - kLeastBeside - kEdge), i) < kLeastBeside) return {};
  const double left = profile.whiteOfFloor(std::max(0, i - kMostBeside), i);
  if (!(profile.white(i) > left + config.minStep)) return {};
  const double rough = kRougher * profile.roughness(std::max(0, i - kRough), i - kEdge);
  const double level = threshold(left, rough, config);
  if (!(profile.white(i) > level)) return {};
  Stretch white{i, i + 1, left, rough, profile.white(i)};
  while (white.end < profile.count() && profile.white(white.end) > level &&
         white.length() <= longest) {
    white.peak = std::max(white.peak, profile.white(white.end));
    ++white.end;
  }
  return white;
}

/// How many pixels to either side have to be floor.
int besideOf(const Stretch& white) {
  return std::clamp(static_cast<int>(kFloorBeside * white.length()), kLeastBeside, kMostBeside);
}

/// Whether there is floor on both sides, and it is white against that behind it, too.
bool isOnFloor(const Stretch& white, int beside, const Profile& profile,
               const LineFinder::Config& config) {
  const int from = white.begin - kEdge - beside;
  const int to = white.end + kEdge + beside;
  return profile.floorIn(from, white.begin) >= kFloorShare * beside &&
         profile.floorIn(white.end, to) >= kFloorShare * beside &&
         white.peak > threshold(profile.whiteOfFloor(white.end, to), white.rough, config);
}

/// Where half the step is reached, between two pixels, on either side.
std::pair<double, double> edgesOf(const Stretch& white, int beside, const Profile& profile) {
  const double right = profile.whiteOfFloor(white.end, white.end + kEdge + beside);
  const double halfLeft = 0.5 * (white.left + white.peak);
  const double halfRight = 0.5 * (right + white.peak);
  int a = white.begin;
  while (a < white.end - 1 && profile.white(a) < halfLeft) ++a;
  int b = white.end - 1;
  while (b > a && profile.white(b) < halfRight) --b;
  const auto part = [](double low, double high, double half) {
    return high > low ? std::clamp((high - half) / (high - low), 0.0, 1.0) : 0.0;
  };
  const double after = b + 1 < profile.count() ? profile.white(b + 1) : 0.0;
  return {a - part(profile.white(a - 1), profile.white(a), halfLeft),
          b + part(after, profile.white(b), halfRight)};
}

constexpr double kSureEvidence = 8.0;  ///< evidence of a crossing that is sure

}  // namespace

LineFinder::LineFinder(const Config& config)
    : config_(config),
      faint_(std::make_unique<FaintLines>()),
      faintScan_(std::make_unique<FaintScan>()) {}
LineFinder::~LineFinder() = default;
LineFinder::LineFinder(LineFinder&&) noexcept = default;
LineFinder& LineFinder::operator=(LineFinder&&) noexcept = default;

std::span<const LinePoint> LineFinder::find(const ImageView& image, const ColourTable& colours) {
  points_.clear();
  faintPoints_.clear();
  if (image.format != PixelFormat::kRgb) return points_;
  longest_ = std::max(
      4, static_cast<int>(config_.mostWidth * std::max(image.size.width, image.size.height)));
  scanAll(image, colours, true);
  scanAll(image, colours, false);
  keepChains(image.size.width, image.size.height);
  points_.insert(points_.end(), faintPoints_.begin(), faintPoints_.end());
  return points_;
}

void LineFinder::scanAll(const ImageView& image, const ColourTable& colours, bool inRows) {
  const auto pitch = static_cast<std::size_t>(image.size.width) * 3;
  const int scans = inRows ? image.size.height : image.size.width;
  const int count = inRows ? image.size.width : image.size.height;
  const auto pointOf = [inRows](const Crossing& c, int at) {
    const auto scanned = static_cast<double>(at);
    return LinePoint{inRows ? Pixel{c.middle, scanned} : Pixel{scanned, c.middle}, c.width, inRows};
  };
  faint_->begin(config_.spacing);
  for (int at = config_.spacing / 2; at < scans; at += config_.spacing) {
    const std::uint8_t* first = image.pixels + static_cast<std::size_t>(at) * (inRows ? pitch : 3);
    scan(first, inRows ? 3 : pitch, count, colours);
    for (const Crossing& c : crossings_) points_.push_back(pointOf(c, at));
    if (!config_.findsFaint) continue;
    const std::size_t across = inRows ? pitch : 3;
    scanFaint({first, at > 0 ? first - across : first, at + 1 < scans ? first + across : first,
               inRows ? 3 : pitch, count});
  }
  for (const FaintLines::Found& found : faint_->finish()) {
    if (found.crossing.isSure) continue;
    const int at = config_.spacing / 2 + found.scan * config_.spacing;
    faintPoints_.push_back(pointOf({found.crossing.middle, found.crossing.width, 0.0}, at));
  }
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
  const Profile profile{white_, floorSum_, whiteSum_, squareSum_};
  for (int i = kLeastBeside + kEdge; i < count - 1; ++i) {
    const std::optional<Stretch> white = whiteFrom(i, profile, config_, longest_);
    if (!white) continue;
    const int beside = besideOf(*white);
    const bool fits = white->length() <= longest_ && white->begin - kEdge - beside >= 0 &&
                      white->end + kEdge + beside <= count;
    if (!fits) continue;
    if (isOnFloor(*white, beside, profile, config_)) {
      const auto [rise, fall] = edgesOf(*white, beside, profile);
      crossings_.push_back({0.5 * (rise + fall), fall - rise, white->peak - white->left});
    }
    i = white->end;
  }
}

void LineFinder::scanFaint(const ScanLine& line) {
  faintCrossings_.clear();
  for (const Crossing& c : crossings_)
    faintCrossings_.push_back({.middle = c.middle,
                               .width = c.width,
                               .step = c.step,
                               .evidence = kSureEvidence,
                               .isSure = true});
  for (const FaintCrossing& faint : faintScan_->find(line, floorSum_)) {
    const bool isKnown = std::any_of(crossings_.begin(), crossings_.end(), [&](const Crossing& c) {
      return std::abs(c.middle - faint.middle) < 0.5 * c.width + 3.0;
    });
    if (!isKnown) faintCrossings_.push_back(faint);
  }
  faint_->add(faintCrossings_);
}

}  // namespace ortung

#include "ortung/vision/BallFinder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace ortung {
namespace {

constexpr int kOutline = 24;                                       ///< places around the outline
constexpr double kStepAround = 2.0 * std::numbers::pi / kOutline;  ///< [rad]
constexpr double kGrid = 0.35;          ///< distance of places that are tried / a ball's radius
constexpr double kLeastGrid = 1.5;      ///< least distance of such places [px]
constexpr double kSquare = 0.65;        ///< half side of a square within a disc / its radius
constexpr double kLeastInside = 0.55;   ///< least share of the ball's colours in it
constexpr double kFrame = 1.5;          ///< half side of a square around it / its radius
constexpr double kMostAround = 0.5;     ///< greatest share of the ball's colours in that
constexpr std::size_t kMostTried = 24;  ///< greatest number of places that are looked at closely
constexpr double kInside = 0.8;         ///< place within the outline that is compared / radius
constexpr double kOutside = 1.25;       ///< place outside of it
constexpr double kBeyond = 1.9;         ///< place at which floor is looked for
constexpr int kLeastBelow = 4;          ///< places below it that tell whether it lies on the floor
constexpr double kLeastFloorBelow = 0.4;   ///< least share of floor there
constexpr double kLeastFloorAround = 0.3;  ///< least share of floor around it
constexpr int kLeastChange = 45;  ///< least change at the outline: sum of three channels of 255
constexpr std::array<double, 5> kScales = {0.76, 0.87, 1.0, 1.15, 1.32};

/// The radius of a ball's image, computed from the images of its sides [px].
std::optional<double> radiusAt(const CameraView& view, const Point3& middle, double radius) {
  const double distance = std::hypot(middle.x, middle.y);
  if (distance < 1e-6) return std::nullopt;
  const double x = -middle.y / distance * radius;
  const double y = middle.x / distance * radius;
  const auto left = view.pixelOf({middle.x + x, middle.y + y, middle.z});
  const auto right = view.pixelOf({middle.x - x, middle.y - y, middle.z});
  if (!left || !right) return std::nullopt;
  return 0.5 * std::hypot(left->u - right->u, left->v - right->v);
}

}  // namespace

/// A picture, and whether its pixels have certain colours.
struct BallFinder::Look {
  const ImageView& image;
  const ColourTable& colours;

  const std::uint8_t* at(const Pixel& p) const {
    const ImageSize size = image.size;
    if (!(p.u > -0.5 && p.v > -0.5 && p.u < size.width - 0.5 && p.v < size.height - 0.5))
      return nullptr;
    const auto column = static_cast<std::size_t>(p.u + 0.5);
    const auto row = static_cast<std::size_t>(p.v + 0.5);
    return image.pixels + 3 * (row * static_cast<std::size_t>(size.width) + column);
  }

  /// How well a disc with an outline fits; negative: it is no ball.
  double score(const Pixel& middle, const Pixel& of, std::span<const Pixel> outline, double scale,
               const Config& config) const {
    int visible = 0, edges = 0, filled = 0;
    int around = 0, floorAround = 0, below = 0, floorBelow = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Pixel& p = outline[k];
      const double du = scale * (p.u - of.u), dv = scale * (p.v - of.v);
      const auto place = [&](double share) {
        return at({middle.u + share * du, middle.v + share * dv});
      };
      const std::uint8_t* inside = place(kInside);
      const std::uint8_t* outside = place(kOutside);
      const std::uint8_t* core = place(0.4);
      if (inside == nullptr || outside == nullptr || core == nullptr) continue;
      ++visible;
      filled += (colours.isBall(inside) ? 1 : 0) + (colours.isBall(core) ? 1 : 0);
      const int change = std::abs(inside[0] - outside[0]) + std::abs(inside[1] - outside[1]) +
                         std::abs(inside[2] - outside[2]);
      edges += colours.isBall(inside) && !colours.isBall(outside) && change >= kLeastChange ? 1 : 0;
      const std::uint8_t* beyond = place(kBeyond);
      const bool isBelow = std::sin(kStepAround * static_cast<double>(k)) < -0.3;
      if (beyond == nullptr) continue;
      const int isFloor = colours.isFloor(beyond) ? 1 : 0;
      ++around;
      floorAround += isFloor;
      below += isBelow ? 1 : 0;
      floorBelow += isBelow ? isFloor : 0;
    }
    // A ball lies on the floor; where what is below it is not in the picture, its sides tell.
    const bool isOnFloor = below >= kLeastBelow ? floorBelow >= kLeastFloorBelow * below
                                                : floorAround >= kLeastFloorAround * around;
    if (2 * visible < kOutline || !isOnFloor) return -1.0;
    const double edge = static_cast<double>(edges) / visible;
    const double fill = 0.5 * filled / visible;
    return edge < config.leastEdge || fill < config.leastFilled ? -1.0 : edge + 0.5 * fill;
  }
};

BallFinder::BallFinder(const CameraView& view, const Config& config)
    : view_(view), config_(config) {
  for (double v = 0.0; v < view_.model().size().height;) {
    leastInRow_ = 1e9;
    addRow(v);
    v += leastInRow_ < 1e9 ? std::max(kLeastGrid, kGrid * leastInRow_) : kLeastGrid;
  }
}

void BallFinder::addRow(double v) {
  for (double u = 0.0; u < view_.model().size().width;) {
    double step = 4.0;
    const auto middle = view_.floorAt({u, v}, config_.radius);
    if (middle && std::hypot(middle->x, middle->y) <= config_.maxRange) {
      const auto radius = radiusAt(view_, *middle, config_.radius);
      if (radius && *radius >= config_.leastRadius) {
        places_.push_back({{u, v}, *radius});
        leastInRow_ = std::min(leastInRow_, *radius);
        step = std::max(kLeastGrid, kGrid * *radius);
      }
    }
    u += step;
  }
}

/// Sums the ball's colours over all rectangles that begin at the first pixel.
void BallFinder::sumUp(const ImageView& image, const ColourTable& colours) {
  const auto width = static_cast<std::size_t>(image.size.width);
  const auto height = static_cast<std::size_t>(image.size.height);
  sums_.resize((width + 1) * (height + 1));
  std::fill_n(sums_.begin(), width + 1, 0);
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* p = image.pixels + 3 * row * width;
    const std::int32_t* above = sums_.data() + row * (width + 1);
    std::int32_t* sums = sums_.data() + (row + 1) * (width + 1);
    std::int32_t inRow = sums[0] = 0;
    for (std::size_t column = 0; column < width; ++column, p += 3) {
      inRow += colours.isBall(p) ? 1 : 0;
      sums[column + 1] = above[column + 1] + inRow;
    }
  }
}

/// The share of the ball's colours in the part of a square that is in the image.
double BallFinder::shareIn(const Pixel& middle, double half) const {
  const ImageSize size = view_.model().size();
  const int left = std::clamp(static_cast<int>(middle.u - half + 0.5), 0, size.width);
  const int right = std::clamp(static_cast<int>(middle.u + half + 1.5), left, size.width);
  const int top = std::clamp(static_cast<int>(middle.v - half + 0.5), 0, size.height);
  const int bottom = std::clamp(static_cast<int>(middle.v + half + 1.5), top, size.height);
  const int area = (right - left) * (bottom - top);
  const auto at = [&](int column, int row) {
    return sums_[static_cast<std::size_t>(row) * static_cast<std::size_t>(size.width + 1) +
                 static_cast<std::size_t>(column)];
  };
  const int sum = at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
  return area > 0 ? static_cast<double>(sum) / area : 0.0;
}

/// The places that have most of the ball's colours within, and fewer around: one of each disc.
std::vector<BallFinder::Place> BallFinder::candidates() const {
  struct Rated {
    const Place* place;
    double contrast;
  };
  std::vector<Rated> rated;
  for (const Place& place : places_) {
    const double inside = shareIn(place.middle, kSquare * place.radius);
    if (inside < kLeastInside) continue;
    const double around = shareIn(place.middle, kFrame * place.radius);
    if (around < kMostAround) rated.push_back({&place, inside - around});
  }
  std::sort(rated.begin(), rated.end(),
            [](const Rated& a, const Rated& b) { return a.contrast > b.contrast; });
  std::vector<Place> chosen;
  for (const Rated& one : rated) {
    if (chosen.size() >= kMostTried) break;
    const bool isNear = std::any_of(chosen.begin(), chosen.end(), [&](const Place& other) {
      return std::hypot(other.middle.u - one.place->middle.u,
                        other.middle.v - one.place->middle.v) < 0.7 * other.radius;
    });
    if (!isNear) chosen.push_back(*one.place);
  }
  return chosen;
}

/// The image of the circle at which rays touch a ball, counter-clockwise from its left as the
/// camera would see it upright: upper half first. Empty if a part of it can't be seen.
std::vector<Pixel> BallFinder::outlineOf(const Pixel& middle) const {
  const auto ball = view_.floorAt(middle, config_.radius);
  if (!ball) return {};
  const double z = view_.place().z;
  const double dx = ball->x, dy = ball->y, dz = ball->z - z;
  const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
  const double across = std::hypot(dx, dy);
  if (distance <= config_.radius * 1.05 || across < 1e-6) return {};
  const double sine = config_.radius / distance;
  const double along = 1.0 - sine * sine;  // of the way to the ball's middle
  const double radius = config_.radius * std::sqrt(along);
  // Two directions across the way: one is level, the other one is across both.
  const double ex = -dy / across, ey = dx / across;
  const double fx = -dx * dz / (across * distance), fy = -dy * dz / (across * distance);
  const double fz = across / distance;
  std::vector<Pixel> outline;
  for (int k = 0; k < kOutline; ++k) {
    const double c = radius * std::cos(kStepAround * k);
    const double s = radius * std::sin(kStepAround * k);
    const auto pixel = view_.pixelOf(
        {along * dx + c * ex + s * fx, along * dy + c * ey + s * fy, z + along * dz + s * fz});
    if (!pixel) return {};
    outline.push_back(*pixel);
  }
  return outline;
}

/// The best disc near a place, of several sizes: the camera's place on the floor is never exact.
BallFinder::Disc BallFinder::bestAround(const Place& place, const Look& look) const {
  Disc best{place.middle, place.radius, -1.0};
  const std::vector<Pixel> outline = outlineOf(place.middle);
  if (outline.empty()) return best;
  const double step = std::max(1.0, 0.2 * place.radius);
  for (int row = -3; row <= 3; ++row)
    for (int column = -3; column <= 3; ++column) {
      const Pixel middle{place.middle.u + step * column, place.middle.v + step * row};
      if (look.at(middle) == nullptr) continue;
      for (const double scale : kScales) {
        const double score = look.score(middle, place.middle, outline, scale, config_) -
                             0.1 * std::abs(std::log(scale));
        if (score > best.score) best = {middle, scale * place.radius, score};
      }
    }
  return best;
}

std::vector<SeenBall> BallFinder::find(const ImageView& image, const ColourTable& colours) {
  if (image.format != PixelFormat::kRgb || !(image.size == view_.model().size())) return {};
  sumUp(image, colours);
  const Look look{image, colours};
  std::vector<Disc> discs;
  for (const Place& place : candidates()) {
    const Disc disc = bestAround(place, look);
    if (disc.score > 0.0) discs.push_back(disc);
  }
  std::sort(discs.begin(), discs.end(),
            [](const Disc& a, const Disc& b) { return a.score > b.score; });
  std::vector<SeenBall> balls;
  std::vector<Disc> taken;
  for (const Disc& disc : discs) {
    const bool isTaken = std::any_of(taken.begin(), taken.end(), [&](const Disc& other) {
      return std::hypot(other.middle.u - disc.middle.u, other.middle.v - disc.middle.v) <
             std::max(other.radius, disc.radius);
    });
    const auto middle = view_.floorAt(disc.middle, config_.radius);
    if (isTaken || !middle) continue;
    taken.push_back(disc);
    balls.push_back({std::hypot(middle->x, middle->y), std::atan2(middle->y, middle->x)});
  }
  std::sort(balls.begin(), balls.end(),
            [](const SeenBall& a, const SeenBall& b) { return a.range < b.range; });
  return balls;
}

}  // namespace ortung

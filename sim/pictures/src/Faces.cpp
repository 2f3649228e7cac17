#include "Faces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace ortung {
namespace {

constexpr double kWidestFace = 1.7;      ///< largest tangent for which one forward face is enough
constexpr double kFaceCosts = 12'000.0;  ///< what a further face costs, in pixels
/// A face is divided only if at most this share of its costs is left.
constexpr double kWorthIt = 0.85;
constexpr std::size_t kMostFaces = 48;
constexpr double kMargin = 1.5;      ///< margin around the needed part of a face [pixels]
constexpr double kQuantile = 0.98;   ///< share of pixels that are drawn at their full resolution
constexpr double kMostTexels = 6.0;  ///< greatest number of texels per pixel of the camera
constexpr double kRoomForAll = 1.05;

struct Tangents {
  double x, y;
};

/// Returns the place of a direction on a face; nothing if it is behind it or far off.
std::optional<Tangents> tangentsOn(const std::array<double, 9>& inCamera, const Point3& r) {
  const std::array<double, 9>& m = inCamera;
  const double z = m[2] * r.x + m[5] * r.y + m[8] * r.z;
  if (z < 0.05) return std::nullopt;
  return Tangents{(m[0] * r.x + m[3] * r.y + m[6] * r.z) / z,
                  (m[1] * r.x + m[4] * r.y + m[7] * r.z) / z};
}

/// Returns the six faces of a cube around the camera's axes; the first looks forward.
std::array<std::array<double, 9>, 6> cube() {
  using Vector = std::array<double, 3>;
  const auto cross = [](const Vector& a, const Vector& b) {
    return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  std::array<std::array<double, 9>, 6> faces{};
  const std::array<std::pair<Vector, Vector>, 6> forwardAndDown{{{{0, 0, 1}, {0, 1, 0}},
                                                                 {{0, 0, -1}, {0, 1, 0}},
                                                                 {{1, 0, 0}, {0, 0, 1}},
                                                                 {{-1, 0, 0}, {0, 0, 1}},
                                                                 {{0, 1, 0}, {0, 0, 1}},
                                                                 {{0, -1, 0}, {0, 0, 1}}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& [forward, down] = forwardAndDown[i];
    const Vector right = cross(down, forward);
    for (std::size_t row = 0; row < 3; ++row) {
      faces[i][3 * row] = right[row];
      faces[i][3 * row + 1] = down[row];
      faces[i][3 * row + 2] = forward[row];
    }
  }
  return faces;
}

std::size_t nearestFace(const Point3& r) {
  const double x = std::abs(r.x), y = std::abs(r.y), z = std::abs(r.z);
  if (z >= x && z >= y) return r.z > 0.0 ? 0 : 1;
  if (x >= y) return r.x > 0.0 ? 2 : 3;
  return r.y > 0.0 ? 4 : 5;
}

/// Some pixels on a face, and the extent and resolution that they need.
struct Region {
  std::vector<std::uint32_t> pixels;
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  double finenessX = 0.0, finenessY = 0.0;  ///< resolution [pixels per tangent]
  double width() const { return std::ceil((right - left) * finenessX) + 2.0 * kMargin; }
  double height() const { return std::ceil((bottom - top) * finenessY) + 2.0 * kMargin; }
  double costs() const { return width() * height() + kFaceCosts; }
};

/// Divides the pixels on one face of the cube among smaller faces.
class Divider {
 public:
  Divider(const PixelRays& rays, const std::array<double, 9>& inCamera)
      : rays_(rays), inCamera_(inCamera) {}

  Region region(std::vector<std::uint32_t> pixels) const {
    Region region;
    std::vector<double> x, y;
    for (const std::uint32_t pixel : pixels) {
      const Tangents t = *tangentsOn(inCamera_, rays_.rays[pixel]);
      region.left = std::min(region.left, t.x);
      region.right = std::max(region.right, t.x);
      region.top = std::min(region.top, t.y);
      region.bottom = std::max(region.bottom, t.y);
      const Tangents size = sizeOf(pixel, t);
      if (size.x > 0.0) x.push_back(1.0 / size.x);
      if (size.y > 0.0) y.push_back(1.0 / size.y);
    }
    region.finenessX = quantile(x);
    region.finenessY = quantile(y);
    region.pixels = std::move(pixels);
    return region;
  }

  void divide(Region region, std::vector<Region>& into) const {
    if (into.size() < kMostFaces) {
      std::optional<std::pair<Region, Region>> best;
      double least = kWorthIt * region.costs();
      for (const bool alongX : {true, false}) {
        auto halves = halve(region, alongX);
        if (!halves || halves->first.costs() + halves->second.costs() >= least) continue;
        least = halves->first.costs() + halves->second.costs();
        best = std::move(halves);
      }
      if (best) {
        divide(std::move(best->first), into);
        divide(std::move(best->second), into);
        return;
      }
    }
    into.push_back(std::move(region));
  }

 private:
  /// Returns the size of a pixel on the face in each direction [tangents].
  Tangents sizeOf(std::uint32_t pixel, const Tangents& here) const {
    const auto width = static_cast<std::uint32_t>(rays_.size.width);
    const std::uint32_t column = pixel % width;
    const auto slope = [&](std::uint32_t other) {
      if (!rays_.isSeen(other)) return Tangents{0.0, 0.0};
      const auto t = tangentsOn(inCamera_, rays_.rays[other]);
      return t ? Tangents{t->x - here.x, t->y - here.y} : Tangents{0.0, 0.0};
    };
    const Tangents u = slope(column + 1 < width ? pixel + 1 : pixel - 1);
    const Tangents v = slope(pixel + width < rays_.rays.size() ? pixel + width : pixel - width);
    return {std::hypot(u.x, v.x), std::hypot(u.y, v.y)};
  }
  static double quantile(std::vector<double>& values) {
    if (values.empty()) return 1.0;
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(
                                            kQuantile * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  }
  std::optional<std::pair<Region, Region>> halve(const Region& whole, bool alongX) const {
    const double middle =
        alongX ? 0.5 * (whole.left + whole.right) : 0.5 * (whole.top + whole.bottom);
    std::vector<std::uint32_t> low, high;
    for (const std::uint32_t pixel : whole.pixels) {
      const Tangents t = *tangentsOn(inCamera_, rays_.rays[pixel]);
      ((alongX ? t.x : t.y) < middle ? low : high).push_back(pixel);
    }
    if (low.empty() || high.empty()) return std::nullopt;
    return std::pair{region(std::move(low)), region(std::move(high))};
  }

  const PixelRays& rays_;
  const std::array<double, 9>& inCamera_;
};

FacePart partOf(const Region& region, const std::array<double, 9>& inCamera, double scale) {
  const double x = scale * region.finenessX;
  const double y = scale * region.finenessY;
  FacePart part;
  part.pixels = region.pixels;
  SheetFace& face = part.face;
  face.inCamera = inCamera;
  face.width = static_cast<int>(std::ceil((region.right - region.left) * x + 2.0 * kMargin));
  face.height = static_cast<int>(std::ceil((region.bottom - region.top) * y + 2.0 * kMargin));
  face.left = region.left - kMargin / x;
  face.top = region.top - kMargin / y;
  face.right = face.left + face.width / x;
  face.bottom = face.top + face.height / y;
  return part;
}

}  // namespace

PixelRays::PixelRays(const CameraModel& model) : size(model.size()) {
  rays.reserve(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u)
      rays.push_back(
          model.unproject({static_cast<double>(u), static_cast<double>(v)}).value_or(Point3{}));
}

std::optional<SheetFace> plainFace(const PixelRays& rays) {
  constexpr double kStraight = 1e-9;
  const auto at = [&](int u, int v) {
    return rays.rays[static_cast<std::size_t>(v) * static_cast<std::size_t>(rays.size.width) +
                     static_cast<std::size_t>(u)];
  };
  const int right = rays.size.width - 1;
  const int bottom = rays.size.height - 1;
  const Point3 first = at(0, 0), last = at(right, bottom);
  if (!(first.z > 0.0) || !(last.z > 0.0)) return std::nullopt;
  const double stepX = (last.x / last.z - first.x / first.z) / right;
  const double stepY = (last.y / last.z - first.y / first.z) / bottom;
  if (!(stepX > 0.0) || !(stepY > 0.0)) return std::nullopt;
  for (int v = 0; v <= bottom; ++v)
    for (int u = 0; u <= right; ++u) {
      const Point3 r = at(u, v);
      if (!(r.z > 0.0) || std::abs(r.x / r.z - first.x / first.z - stepX * u) > kStraight ||
          std::abs(r.y / r.z - first.y / first.z - stepY * v) > kStraight)
        return std::nullopt;
    }
  SheetFace face;
  face.width = rays.size.width;
  face.height = rays.size.height;
  face.left = first.x / first.z - 0.5 * stepX;
  face.right = last.x / last.z + 0.5 * stepX;
  face.top = first.y / first.z - 0.5 * stepY;
  face.bottom = last.y / last.z + 0.5 * stepY;
  return face;
}

std::vector<FacePart> facesFor(const PixelRays& rays) {
  const std::array<std::array<double, 9>, 6> sides = cube();
  std::array<std::vector<std::uint32_t>, 6> pixels;
  bool forwardWillDo = true;
  for (std::uint32_t i = 0; i < rays.rays.size(); ++i) {
    if (!rays.isSeen(i)) continue;
    const auto t = tangentsOn(sides[0], rays.rays[i]);
    forwardWillDo =
        forwardWillDo && t && std::abs(t->x) < kWidestFace && std::abs(t->y) < kWidestFace;
    pixels[nearestFace(rays.rays[i])].push_back(i);
  }
  if (forwardWillDo)
    for (std::size_t i = 1; i < 6; ++i) {
      pixels[0].insert(pixels[0].end(), pixels[i].begin(), pixels[i].end());
      pixels[i].clear();
    }
  std::vector<std::pair<std::size_t, Region>> regions;
  double texels = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    if (pixels[i].empty()) continue;
    const Divider divider(rays, sides[i]);
    std::vector<Region> parts;
    divider.divide(divider.region(std::move(pixels[i])), parts);
    for (Region& part : parts) {
      texels += part.width() * part.height();
      regions.emplace_back(i, std::move(part));
    }
  }
  if (regions.empty()) throw std::invalid_argument("the camera sees nothing");
  const double most = kMostTexels * static_cast<double>(rays.rays.size());
  const double scale = texels > most ? std::sqrt(most / texels) : 1.0;
  std::vector<FacePart> parts;
  for (const auto& [side, region] : regions) parts.push_back(partOf(region, sides[side], scale));
  return parts;
}

// The faces are packed in rows, the highest first.
ImageSize pack(std::span<FacePart> parts) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return parts[a].face.height > parts[b].face.height;
  });
  double texels = 0.0;
  int widest = 0;
  for (const FacePart& part : parts) {
    texels += static_cast<double>(part.face.width) * part.face.height;
    widest = std::max(widest, part.face.width);
  }
  ImageSize sheet{std::max(widest, static_cast<int>(kRoomForAll * std::sqrt(texels))), 0};
  int column = 0, row = 0, height = 0;
  for (const std::size_t i : order) {
    SheetFace& face = parts[i].face;
    if (column + face.width > sheet.width) {
      row += height;
      column = height = 0;
    }
    face.column = column;
    face.row = row;
    column += face.width;
    height = std::max(height, face.height);
    sheet.height = std::max(sheet.height, row + face.height);
  }
  if (sheet.width > Drawing::kMostPixels || sheet.height + 2 > Drawing::kMostPixels)
    throw std::invalid_argument("the camera's picture would have to be drawn on a sheet of " +
                                std::to_string(sheet.width) + " x " + std::to_string(sheet.height) +
                                " pixels, expected at most 8192 to a side: make it smaller");
  return sheet;
}

}  // namespace ortung

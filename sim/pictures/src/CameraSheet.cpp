#include "ortung/pictures/CameraSheet.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "Faces.hpp"
#include "Resampling.hpp"

namespace ortung {
namespace {

constexpr long kShares = 128;

/// Returns the place of a direction on the sheet; the middles of texels are at whole numbers.
CameraSheet::Place placeOf(const SheetFace& face, const Point3& r, int sheetWidth) {
  const std::array<double, 9>& m = face.inCamera;
  const double z = m[2] * r.x + m[5] * r.y + m[8] * r.z;
  const double x = (m[0] * r.x + m[3] * r.y + m[6] * r.z) / z;
  const double y = (m[1] * r.x + m[4] * r.y + m[7] * r.z) / z;
  const double column = (x - face.left) / (face.right - face.left) * face.width - 0.5;
  const double row = (y - face.top) / (face.bottom - face.top) * face.height - 0.5;
  const long along =
      std::lround(kShares * std::clamp(column, 0.0, face.width - 1.0 - 1.0 / kShares));
  const long down = std::lround(kShares * std::clamp(row, 0.0, face.height - 1.0 - 1.0 / kShares));
  CameraSheet::Place place;
  place.texel = static_cast<std::uint32_t>((face.row + down / kShares) * sheetWidth + face.column +
                                           along / kShares);
  place.right = static_cast<std::uint16_t>(along % kShares);
  place.below = static_cast<std::uint16_t>(down % kShares);
  return place;
}

}  // namespace

CameraSheet::CameraSheet(const CameraModel& model) : picture_(model.size()) {
  const PixelRays rays(model);
  if (const auto plain = plainFace(rays)) {
    faces_.push_back(*plain);
    size_ = picture_;
    return;
  }
  std::vector<FacePart> parts = facesFor(rays);
  size_ = pack(parts);
  // Two more rows, which no face covers.
  nowhere_ = static_cast<std::uint32_t>(size_.height * size_.width);
  size_.height += 2;
  places_.assign(rays.rays.size(), {nowhere_, 0, 0});
  for (const FacePart& part : parts) {
    faces_.push_back(part.face);
    for (const std::uint32_t pixel : part.pixels)
      places_[pixel] = placeOf(part.face, rays.rays[pixel], size_.width);
  }
}

void CameraSheet::blacken(std::span<std::uint32_t> sheet) const {
  if (!isPicture()) std::fill(sheet.begin() + nowhere_, sheet.end(), 0U);
}

void CameraSheet::resample(std::span<const std::uint32_t> sheet, int first, int count,
                           std::span<std::uint32_t> out) const {
  const auto width = static_cast<std::size_t>(picture_.width);
  const std::size_t from = static_cast<std::size_t>(first) * width;
  assert(out.size() == static_cast<std::size_t>(count) * width);
  if (isPicture()) {
    std::copy_n(sheet.begin() + static_cast<std::ptrdiff_t>(from), out.size(), out.begin());
    return;
  }
  resampleRow(sheet.data(), static_cast<std::size_t>(size_.width),
              std::span(places_).subspan(from, out.size()), out.data());
  static_cast<void>(count);
}

}  // namespace ortung

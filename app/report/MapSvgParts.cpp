#include "MapSvgParts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "Axis.hpp"
#include "Base64.hpp"
#include "FieldMarks.hpp"
#include "LandmarkLabels.hpp"
#include "Picture.hpp"
#include "Report.hpp"

namespace ortung::app {
namespace {

// The region's picture is a mask: it says how much of the page's colour for solids a cell gets.
constexpr Colour kSolid{255, 255, 255};
constexpr Colour kNotStandable{40, 40, 40};
constexpr Colour kStandable{0, 0, 0};
constexpr int kMaxPixels = 4096;  ///< greatest length of the map's longer side [px]

/// Returns the region as a picture with a pixel for each cell. In maps too large for a page a pixel
/// stands for several cells, and is solid if one of them is, so that thin walls stay.
std::string maskPng(const FieldRegion& region) {
  const FieldGrid& grid = region.grid;
  const int every = std::max(grid.columns, grid.rows) / kMaxPixels + 1;
  const int width = (grid.columns + every - 1) / every;
  const int height = (grid.rows + every - 1) / every;
  Picture picture(width, height, kStandable);
  for (int pass = 0; pass < 2; ++pass) {  // solid cells last, over all others
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      const bool isSolid = region.open[cell] == 0;
      if (isSolid != (pass == 1) || (!isSolid && region.standable[cell] != 0)) continue;
      const auto columns = static_cast<std::size_t>(grid.columns);
      const int x = static_cast<int>(cell % columns) / every;
      const int y = static_cast<int>(cell / columns) / every;
      picture.set(x, height - 1 - y, isSolid ? kSolid : kNotStandable);
    }
  }
  return base64(picture.png());
}

}  // namespace

MapFrame::MapFrame(const FieldGrid& grid)
    : left(grid.originX),
      low(grid.originY),
      width(grid.columns * grid.cell),
      height(grid.rows * grid.cell),
      letter(0.018 * std::max(grid.columns, grid.rows) * grid.cell) {}

std::string viewBox(const MapFrame& f) {
  return fmt::format("{:.3f} {:.3f} {:.3f} {:.3f}", f.left - 4.5 * f.letter,
                     -f.high() - 2.0 * f.letter, f.width + 6.0 * f.letter,
                     f.height + 7.0 * f.letter);
}

std::string regionSvg(const FieldRegion& region, const MapFrame& f) {
  const std::string box = fmt::format(R"(x="{:.3f}" y="{:.3f}" width="{:.3f}" height="{:.3f}")",
                                      f.left, -f.high(), f.width, f.height);
  return fmt::format(
      R"(<mask id="region" maskUnits="userSpaceOnUse" {0}><image {0} preserveAspectRatio="none" )"
      R"(href="data:image/png;base64,{1}"/></mask><rect class="floor" {0}/>)"
      R"x(<rect class="solid" mask="url(#region)" {0}/>)x",
      box, maskPng(region));
}

std::string axesSvg(const MapFrame& f) {
  constexpr int kTicks = 12;
  const double wide = std::max(f.width, f.height);
  const auto ticksOf = [&](double low, double length) {
    return axisTicks(low, low + length, std::max(2, static_cast<int>(kTicks * length / wide)));
  };
  std::string svg =
      fmt::format(R"(<g class="axes" font-size="{:.3f}" aria-hidden="true">)", f.letter);
  for (const double x : ticksOf(f.left, f.width)) {
    svg += fmt::format(
        R"(<path d="M{0:.3f} {1:.3f}v{2:.3f}"/><text x="{0:.3f}" y="{3:.3f}">{4:.6g}</text>)", x,
        -f.high(), f.height, -f.low + 1.3 * f.letter, x);
  }
  for (const double y : ticksOf(f.low, f.height)) {
    svg += fmt::format(R"(<path d="M{0:.3f} {1:.3f}h{2:.3f}"/>)"
                       R"(<text class="y" x="{3:.3f}" y="{4:.3f}">{5:.6g}</text>)",
                       f.left, -y, f.width, f.left - 0.5 * f.letter, -y + 0.35 * f.letter, y);
  }
  svg += fmt::format(R"(<text x="{:.3f}" y="{:.3f}">x [m]</text>)", f.left + 0.5 * f.width,
                     -f.low + 2.8 * f.letter);
  svg += fmt::format(R"(<text class="y" x="{:.3f}" y="{:.3f}">y [m]</text></g>)",
                     f.left - 0.5 * f.letter, -f.high() - 0.9 * f.letter);
  const double bar = roundLength(f.width / 5.0);
  svg += fmt::format(
      R"(<g class="bar" aria-hidden="true"><path d="M{0:.3f} {1:.3f}v{4:.3f}h{2:.3f}v-{4:.3f}"/>)"
      R"(<text x="{3:.3f}" y="{1:.3f}" font-size="{5:.3f}">{2:g} m</text></g>)",
      f.left, -f.low + 3.9 * f.letter, bar, f.left + 0.5 * bar, 0.4 * f.letter, f.letter);
  return svg;
}

std::string linesSvg(const FieldModel& field) {
  std::string path;
  for (std::size_t i = 0; i < std::min(field.lines.size(), kMostMarks); ++i) {
    const char* command = "M";
    for (const auto& [x, y] : pointsOf(field.lines[i])) {
      path += fmt::format("{}{:.3f} {:.3f}", command, x, y);
      command = "L";
    }
  }
  return path.empty() ? "" : fmt::format(R"(<path class="line" d="{}"/>)", path);
}

std::string changesSvg(const MapChanges& changes) {
  std::string svg;
  for (const MapChange::Kind kind : {MapChange::Kind::kGone, MapChange::Kind::kNew}) {
    const std::size_t count = changes.sure(kind);
    if (count == 0) continue;
    const bool isNew = kind == MapChange::Kind::kNew;
    svg += fmt::format(R"(<path class="{}" d=")", isNew ? "fresh" : "gone");
    constexpr double kCell = MapChanges::kCell;
    for (const MapChange& one : changes.cells)
      if (one.isSure && one.kind == kind)
        svg += fmt::format("M{:.2f} {:.2f}h{:g}v{:g}h-{:g}z", one.x - 0.5 * kCell,
                           one.y - 0.5 * kCell, kCell, kCell, kCell);
    svg += fmt::format(R"("><title>{}: {} cells</title></path>)",
                       isNew ? "something new" : "walls that are gone", count);
  }
  return svg;
}

std::string landmarksSvg(const FieldModel& field, const MapFrame& f) {
  std::string svg = R"(<g class="landmarks">)";
  const std::size_t count = std::min(field.landmarks.size(), kMostMarks);
  const std::vector<LandmarkLabel> labels = labelsOf(field, 0.75 * f.letter, f.right());
  const double half = 0.45 * f.letter;
  for (std::size_t i = 0; i < count; ++i) {
    const Landmark& mark = field.landmarks[i];
    const std::string name = fmt::format("{} {}", escapeHtml(mark.kind), mark.identity);
    svg += fmt::format(
        R"(<g class="landmark"><title>{0} at {1:.3f} m, {2:.3f} m</title>)"
        R"(<path d="M{3:.3f} {2:.3f}l{4:.3f} {4:.3f}l{4:.3f} -{4:.3f}l-{4:.3f} -{4:.3f}z"/>)",
        name, mark.x, mark.y, mark.x - half, half);
    if (i < labels.size()) {
      svg += fmt::format(
          R"x(<text class="{4}" transform="translate({0:.3f} {1:.3f}) scale(1 -1)" font-size="{2:.3f}">{3}</text>)x",
          mark.x + (labels[i].isLeft ? -1.4 : 1.4) * half, mark.y - 0.6 * half, 0.75 * f.letter,
          escapeHtml(labels[i].text), labels[i].isLeft ? "left" : "right");
    }
    svg += "</g>";
  }
  return count == 0 ? "" : svg + "</g>";
}

}  // namespace ortung::app

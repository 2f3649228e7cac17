#include "HeatMap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "FieldCanvas.hpp"
#include "LandmarkLabels.hpp"
#include "Palette.hpp"

namespace ortung::app {
namespace {

constexpr int kWantedWidth = 800;  // width of the field [px]
constexpr int kWantedHeight = 1000;
constexpr int kMostZoom = 40;
constexpr int kMargin = 16;
constexpr int kAxisLeft = 70;   // width of the labels left of the field [px]
constexpr int kAxisBelow = 54;  // height of the labels below it [px]
constexpr int kBarHeight = 16;
constexpr int kTicks = 5;
constexpr int kLetters = 2;  // size of a font pixel
constexpr int kLineHeight = 12 * kLetters;
constexpr double kCutOff = 0.05;  // share of cells at the pale end of a logarithmic scale

int zoomOf(const FieldGrid& grid) {
  const int byWidth = (kWantedWidth + grid.columns - 1) / grid.columns;
  const int byHeight = (kWantedHeight + grid.rows - 1) / grid.rows;
  return std::clamp(std::min(byWidth, byHeight), 1, kMostZoom);
}

/// Returns the place of a value between pale (0) and dark (1).
double darkness(const HeatMap& map, const HeatMap::Scale& scale, double value) {
  if (!(scale.high > scale.low)) return 0.5;
  if (!map.logarithmic) return (value - scale.low) / (scale.high - scale.low);
  return std::log(std::max(value, scale.low) / scale.low) / std::log(scale.high / scale.low);
}

/// Returns the values of open cells that have one.
std::vector<double> openValues(const HeatMap& map) {
  std::vector<double> open;
  for (std::size_t cell = 0; cell < map.values.size(); ++cell) {
    if (map.region->open[cell] != 0 && std::isfinite(map.values[cell]))
      open.push_back(map.values[cell]);
  }
  return open;
}

/// Draws cells with the grid's upper left corner at a place of the picture.
class CellPainter {
 public:
  CellPainter(Picture& picture, const HeatMap& map, int left, int top)
      : picture_(picture),
        map_(map),
        grid_(map.region->grid),
        zoom_(zoomOf(grid_)),
        left_(left),
        top_(top) {}

  void paint() {
    const HeatMap::Scale scale = map_.scale();
    picture_.fill(left_ - 1, top_ - 1, grid_.columns * zoom_ + 2, grid_.rows * zoom_ + 2,
                  palette::kInk);
    for (int row = 0; row < grid_.rows; ++row) {
      for (int column = 0; column < grid_.columns; ++column) {
        picture_.fill(left(column), above(row), zoom_, zoom_, colourOf(column, row, scale));
        if (!isOpen(column, row)) outline(column, row);
      }
    }
  }

 private:
  bool isOpen(int column, int row) const {
    if (column < 0 || row < 0 || column >= grid_.columns || row >= grid_.rows) return false;
    return map_.region->open[index(column, row)] != 0;
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) +
           static_cast<std::size_t>(column);
  }
  int left(int column) const { return left_ + column * zoom_; }
  int above(int row) const { return top_ + (grid_.rows - 1 - row) * zoom_; }

  Colour colourOf(int column, int row, const HeatMap::Scale& scale) const {
    if (!isOpen(column, row)) return palette::kSolid;
    const double value = map_.values[index(column, row)];
    return std::isfinite(value) ? palette::sequential(darkness(map_, scale, value))
                                : palette::kNoValue;
  }

  /// Draws dark lines within a solid cell, at the sides of its open neighbours.
  void outline(int column, int row) {
    const int thick = std::max(1, zoom_ / 4);
    const int x = left(column);
    const int y = above(row);
    if (isOpen(column - 1, row)) picture_.fill(x, y, thick, zoom_, palette::kInk);
    if (isOpen(column + 1, row)) picture_.fill(x + zoom_ - thick, y, thick, zoom_, palette::kInk);
    if (isOpen(column, row + 1)) picture_.fill(x, y, zoom_, thick, palette::kInk);
    if (isOpen(column, row - 1)) picture_.fill(x, y + zoom_ - thick, zoom_, thick, palette::kInk);
  }

  Picture& picture_;
  const HeatMap& map_;
  const FieldGrid& grid_;
  int zoom_;
  int left_;
  int top_;
};

/// Draws the bar of colours with its values.
void drawScale(Picture& picture, const HeatMap& map, int left, int top, int width) {
  for (int x = 0; x < width; ++x) {
    picture.fill(left + x, top, 1, kBarHeight, palette::sequential(static_cast<double>(x) / width));
  }
  const std::vector<double> values = map.legend(kTicks);
  for (int tick = 0; tick < kTicks; ++tick) {
    const std::string text =
        fmt::format("{:.3g}{}{}", values[static_cast<std::size_t>(tick)],
                    map.unit.empty() ? "" : " ", tick == kTicks - 1 ? map.unit : "");
    const int centre = left + tick * width / (kTicks - 1);
    const int room = picture.width() - kMargin - Picture::textWidth(kLetters, text);
    const int x = centre - Picture::textWidth(kLetters, text) / 2;
    picture.fill(std::min(centre, left + width - 1), top + kBarHeight, 1, 4, palette::kInk);
    picture.text(std::clamp(x, kMargin, std::max(room, kMargin)), top + kBarHeight + 7, kLetters,
                 palette::kInk, text);
  }
  const std::string name = map.quantity + (map.logarithmic ? " (logarithmic scale)" : "");
  picture.text(left, top + kBarHeight + 7 + kLineHeight, kLetters, palette::kInk, name);
}

/// Returns e.g. "landmark (post)" if all are of one kind.
std::string landmarkName(const FieldModel& field) {
  const std::string kind = commonKind(field);
  return kind.empty() ? "landmark" : fmt::format("landmark ({})", kind);
}

/// Draws the legend of the marks, and of the colours that are not values: entries side by side, on
/// a new line if there is no room. Returns the number of lines; draws nothing if @p picture is
/// null.
int drawKey(Picture* picture, const HeatMap& map, int left, int top, int width) {
  int x = 0;
  int row = 0;
  const auto entry = [&](const std::string& text, auto&& symbol) {
    const int taken = 52 + Picture::textWidth(kLetters, text) + 24;
    if (x > 0 && x + taken > width) {
      x = 0;
      ++row;
    }
    if (picture != nullptr) {
      const int middle = top + row * 2 * kLineHeight + kLineHeight;
      symbol(left + x + 18, middle);
      picture->text(left + x + 52, middle - 7, kLetters, palette::kInk, text);
    }
    x += taken;
  };
  const auto box = [&](Colour colour) {
    return [picture, colour](int at, int middle) {
      picture->fill(at - 12, middle - 8, 24, 16, palette::kInk);
      picture->fill(at - 11, middle - 7, 22, 14, colour);
    };
  };
  const FieldRegion& region = *map.region;
  const auto cells =
      static_cast<std::size_t>(std::count(region.open.begin(), region.open.end(), 1));
  if (map.truth)
    entry("true pose", [&](int at, int m) { FieldCanvas::drawTruth(*picture, at - 6, m, 0.0); });
  if (map.marksBest)
    entry("most probable cell",
          [&](int at, int m) { FieldCanvas::drawBest(*picture, at, m, 8.0); });
  if (map.field != nullptr && !map.field->landmarks.empty())
    entry(landmarkName(*map.field),
          [&](int at, int m) { FieldCanvas::drawLandmark(*picture, at, m, 7); });
  if (cells < region.grid.size()) entry("solid, unknown or outside", box(palette::kSolid));
  if (openValues(map).size() < cells) entry("nothing expected", box(palette::kNoValue));
  return x == 0 ? 0 : row + 1;
}

/// Draws the caption in letters as large as fit.
void drawCaption(Picture& picture, int y, const std::string& text) {
  const bool fits = Picture::textWidth(kLetters, text) <= picture.width() - 2 * kMargin;
  picture.text(kMargin, y, fits ? kLetters : 1, palette::kInk, text);
}

}  // namespace

HeatMap::Scale HeatMap::scale() const {
  std::vector<double> open = openValues(*this);
  if (logarithmic) std::erase_if(open, [](double value) { return !(value > 0.0); });
  if (open.empty()) return {};
  const auto [least, greatest] = std::minmax_element(open.begin(), open.end());
  Scale ends{*least, *greatest};
  if (logarithmic) {
    const auto low =
        open.begin() + static_cast<std::ptrdiff_t>(kCutOff * static_cast<double>(open.size()));
    std::nth_element(open.begin(), low, open.end());
    if (*low < ends.high) ends.low = *low;
  } else if (ends.low > 0.0 && ends.low < ends.high * 1e-6) {
    ends.low = 0.0;  // a legend that begins at 1e-157 is of no use
  }
  return ends;
}

std::vector<double> HeatMap::legend(int count) const {
  const Scale ends = scale();
  std::vector<double> at;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    const bool byLogarithm = logarithmic && ends.low > 0.0;
    at.push_back(byLogarithm ? ends.low * std::pow(ends.high / ends.low, share)
                             : ends.low + share * (ends.high - ends.low));
  }
  return at;
}

std::optional<std::size_t> HeatMap::best() const {
  std::optional<std::size_t> found;
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    if (region->open[cell] == 0 || !std::isfinite(values[cell])) continue;
    if (!found || values[cell] > values[*found]) found = cell;
  }
  return found;
}

bool HeatMap::isPeaked() const {
  const std::vector<double> open = openValues(*this);
  if (open.empty()) return false;
  const double top = *std::max_element(open.begin(), open.end());
  const auto seen =
      std::count_if(open.begin(), open.end(), [&](double v) { return v > 0.1 * top; });
  return static_cast<double>(seen) < 0.02 * static_cast<double>(open.size());
}

Picture draw(const HeatMap& map) {
  const FieldGrid& grid = map.region->grid;
  const int zoom = zoomOf(grid);
  const int left = kMargin + kAxisLeft;
  const int top = kMargin + (map.note.empty() ? 1 : 2) * kLineHeight + kLineHeight + 8;
  const int scaleTop = top + grid.rows * zoom + kAxisBelow + 8;
  const int keyTop = scaleTop + kBarHeight + 2 * kLineHeight + 12;
  const int room = std::max(grid.columns * zoom, kWantedWidth / 2);
  const int width = left + room + 2 * kMargin;
  const int keyLines = drawKey(nullptr, map, left, keyTop, room);
  Picture picture(width, keyTop + keyLines * 2 * kLineHeight + kMargin, palette::kPaper);
  drawCaption(picture, kMargin, map.caption);
  if (!map.note.empty()) drawCaption(picture, kMargin + kLineHeight, map.note);

  CellPainter(picture, map, left, top).paint();
  const FieldCanvas canvas(picture, grid, left, top, zoom);
  canvas.axes();
  if (map.field != nullptr) canvas.field(*map.field);
  if (map.truth) canvas.truth(*map.truth);
  if (const auto best = map.best(); best && map.marksBest)
    canvas.best(grid.centreX(*best), grid.centreY(*best));
  drawScale(picture, map, left, scaleTop, room);
  drawKey(&picture, map, left, keyTop, room);
  return picture;
}

}  // namespace ortung::app

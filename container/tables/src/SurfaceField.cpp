#include "ortung/tables/SurfaceField.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostCells = 1U << 27;
constexpr int kWidest = 2;  ///< cells to either side that take part in a cell's surface
/// Greatest thickness of a surface [cells]; the stairs of a slanting wall in a grid have 0.3.
constexpr double kThickest = 0.35;
/// Share of the fullest neighbour's ends; cells with fewer count less.
constexpr double kFewEnds = 0.2;
constexpr double kLineRatio = 0.45;  ///< greatest ratio of a line's thickness to its length
/// Least thickness, since ends are in whole millimetres [m].
constexpr double kThinnest = 0.0005;
/// Greatest distance of a file's means from their cell's centre [cells].
constexpr float kMostCellsOff = 1.0F;

}  // namespace

void SurfaceField::Sums::add(double px, double py) {
  count += 1.0;
  x += px;
  y += py;
  xx += px * px;
  xy += px * py;
  yy += py * py;
}

SurfaceField::Ends SurfaceField::Sums::ends() const {
  const double mx = x / count;
  const double my = y / count;
  return {static_cast<float>(mx),
          static_cast<float>(my),
          static_cast<float>(xx / count - mx * mx),
          static_cast<float>(xy / count - mx * my),
          static_cast<float>(yy / count - my * my),
          static_cast<float>(count)};
}

void SurfaceField::checkAndClear() {
  if (!(grid_.cell > 0.0) || grid_.columns < 1 || grid_.rows < 1 ||
      static_cast<double>(grid_.columns) * grid_.rows > static_cast<double>(kMostCells)) {
    throw std::invalid_argument("a field of surfaces has 1 to 2^27 cells; choose a larger cell");
  }
  blockColumns_ = static_cast<std::size_t>((grid_.columns + kBlock - 1) / kBlock);
  blockOf_.assign(blockColumns_ * static_cast<std::size_t>((grid_.rows + kBlock - 1) / kBlock), -1);
  blocks_.clear();
  cells_.clear();
  ends_.clear();
  surfaces_.clear();
  sums_.clear();
}

void SurfaceField::start(const FieldRegion& region, double cell, double margin) {
  const FieldGrid& grid = region.grid;
  sigma_ = region.surfaceSigma;
  grid_ = {
      grid.originX - margin, grid.originY - margin, cell,
      static_cast<int>(std::min(1e9, std::ceil((grid.columns * grid.cell + 2 * margin) / cell))),
      static_cast<int>(std::min(1e9, std::ceil((grid.rows * grid.cell + 2 * margin) / cell)))};
  checkAndClear();
}

std::int32_t& SurfaceField::numberFor(int column, int row) {
  std::int32_t& block = blockOf_[blockAt(column, row)];
  if (block < 0) {
    block = static_cast<std::int32_t>(blocks_.size());
    blocks_.emplace_back().fill(-1);
  }
  return blocks_[static_cast<std::size_t>(block)][within(column, row)];
}

void SurfaceField::mark(double x, double y) {
  const std::ptrdiff_t cell = grid_.cellAt(x, y);
  if (cell < 0) return;
  const auto column = static_cast<int>(cell % grid_.columns);
  const auto row = static_cast<int>(cell / grid_.columns);
  std::int32_t& number = numberFor(column, row);
  if (number < 0) {
    number = static_cast<std::int32_t>(sums_.size());
    sums_.emplace_back();
    cells_.push_back(static_cast<std::int32_t>(cell));
  }
  sums_[static_cast<std::size_t>(number)].add((x - grid_.originX) / grid_.cell - column - 0.5,
                                              (y - grid_.originY) / grid_.cell - row - 0.5);
}

void SurfaceField::finish() {
  ends_.clear();
  for (const Sums& sums : sums_) ends_.push_back(sums.ends());
  sums_ = {};
  makeSurfaces();
}

void SurfaceField::makeSurfaces() {
  surfaces_.clear();
  for (std::size_t number = 0; number < cells_.size(); ++number)
    surfaces_.push_back(surfaceOf(number));
  spreadNumbers();
}

/// Returns the surface of as many neighbours as lie on one line with the cell's ends. Cells count
/// alike, except those with few ends, which beams hit between others: through gaps, at corners that
/// they graze.
Surface SurfaceField::surfaceOf(std::size_t number) const {
  const std::int32_t cell = cells_[number];
  const int column = cell % grid_.columns;
  const int row = cell / grid_.columns;
  const auto forNeighbours = [&](int radius, const auto& visit) {
    for (int r = std::max(0, row - radius); r <= std::min(grid_.rows - 1, row + radius); ++r)
      for (int c = std::max(0, column - radius); c <= std::min(grid_.columns - 1, column + radius);
           ++c) {
        const std::int32_t other =
            numberAt(static_cast<std::size_t>(r) * static_cast<std::size_t>(grid_.columns) +
                     static_cast<std::size_t>(c));
        if (other >= 0) visit(ends_[static_cast<std::size_t>(other)], c - column, r - row);
      }
  };
  double most = 0.0;
  forNeighbours(kWidest, [&](const Ends& ends, int, int) {
    most = std::max(most, static_cast<double>(ends.count));
  });
  Surface surface;
  for (int radius = kWidest; radius >= 0; --radius) {
    double n = 0.0;
    double x = 0.0;
    double y = 0.0;
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    forNeighbours(radius, [&](const Ends& ends, int columnsOff, int rowsOff) {
      const double weight = std::min(1.0, static_cast<double>(ends.count) / (kFewEnds * most));
      const double ex = static_cast<double>(ends.x) + columnsOff;
      const double ey = static_cast<double>(ends.y) + rowsOff;
      n += weight;
      x += weight * ex;
      y += weight * ey;
      xx += weight * (ex * ex + static_cast<double>(ends.xx));
      xy += weight * (ex * ey + static_cast<double>(ends.xy));
      yy += weight * (ey * ey + static_cast<double>(ends.yy));
    });
    x /= n;
    y /= n;
    const double sxx = xx / n - x * x;
    const double sxy = xy / n - x * y;
    const double syy = yy / n - y * y;
    const double middle = 0.5 * (sxx + syy);
    const double apart = std::hypot(0.5 * (sxx - syy), sxy);
    const double across = std::sqrt(std::max(0.0, middle - apart));
    const double along = std::sqrt(std::max(0.0, middle + apart));
    // This is the direction of their least spread.
    const double angle = 0.5 * std::atan2(2.0 * sxy, sxx - syy) + 0.25 * kTurn;
    surface.x = static_cast<float>(grid_.originX + (column + 0.5 + x) * grid_.cell);
    surface.y = static_cast<float>(grid_.originY + (row + 0.5 + y) * grid_.cell);
    surface.normalX = static_cast<float>(std::cos(angle));
    surface.normalY = static_cast<float>(std::sin(angle));
    surface.across =
        static_cast<float>(std::hypot(std::max(kThinnest, across * grid_.cell), sigma_));
    const bool isLine = across < kLineRatio * along;
    surface.along = isLine ? -1.0F : static_cast<float>(std::max(kThinnest, along * grid_.cell));
    if (isLine && across < kThickest) break;
  }
  return surface;
}

/// Writes the number of the nearest surface into the cells around surfaces.
void SurfaceField::spreadNumbers() {
  struct Offset {
    int column;
    int row;
  };
  std::vector<Offset> offsets;
  for (int r = -kReach; r <= kReach; ++r)
    for (int c = -kReach; c <= kReach; ++c)
      if (const int squared = r * r + c * c; squared > 0 && squared <= kReach * kReach)
        offsets.push_back({c, r});
  const auto squared = [](const Offset& o) { return o.column * o.column + o.row * o.row; };
  std::stable_sort(offsets.begin(), offsets.end(),
                   [&](const Offset& a, const Offset& b) { return squared(a) < squared(b); });
  for (const Offset& offset : offsets) {  // nearer ones come first
    for (std::size_t number = 0; number < cells_.size(); ++number) {
      const int column = cells_[number] % grid_.columns + offset.column;
      const int row = cells_[number] / grid_.columns + offset.row;
      if (column < 0 || row < 0 || column >= grid_.columns || row >= grid_.rows) continue;
      std::int32_t& nearest = numberFor(column, row);
      if (nearest < 0) nearest = static_cast<std::int32_t>(number);
    }
  }
}

void SurfaceField::save(TableWriter& file, const std::string& prefix) const {
  const double place[] = {grid_.originX,
                          grid_.originY,
                          grid_.cell,
                          static_cast<double>(grid_.columns),
                          static_cast<double>(grid_.rows),
                          sigma_};
  file.add<double>(prefix + "surface_grid", {6}, place);
  file.add<std::int32_t>(prefix + "surface_cells", {cells_.size()}, cells_);
  std::vector<float> values;
  for (const Ends& e : ends_) values.insert(values.end(), {e.x, e.y, e.xx, e.xy, e.yy, e.count});
  file.add<float>(prefix + "surface_ends", {ends_.size(), 6}, values);
}

void SurfaceField::load(const std::shared_ptr<const TableFile>& shared, const std::string& prefix) {
  const TableFile& file = *shared;
  const auto& arrays = file.arrays();
  const auto has = [&](const TableArray& a) { return a.name == prefix + "surface_grid"; };
  *this = {};
  if (std::none_of(arrays.begin(), arrays.end(), has)) return;
  const auto refuse = [&](const char* what) {
    throw TableError(file.path().string() + ": table " + prefix + what + " has impossible values");
  };
  const auto place = file.get<double>(prefix + "surface_grid", {6});
  const auto isCount = [](double v) { return v >= 1.0 && v == std::floor(v); };
  if (!std::isfinite(place[0]) || !std::isfinite(place[1]) || !(place[2] > 1e-4) ||
      !(place[2] < 1e3) || !isCount(place[3]) || !isCount(place[4]) ||
      place[3] * place[4] > static_cast<double>(kMostCells) || !(place[5] >= 0.0 && place[5] < 1e3))
    refuse("surface_grid");
  grid_ = {place[0], place[1], place[2], static_cast<int>(place[3]), static_cast<int>(place[4])};
  sigma_ = place[5];
  checkAndClear();
  const auto cells = file.get<std::int32_t>(prefix + "surface_cells", {0});
  const auto values = file.get<float>(prefix + "surface_ends", {cells.size(), 6});
  const auto most = static_cast<std::int32_t>(grid_.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const Ends e{values[6 * k],     values[6 * k + 1], values[6 * k + 2],
                 values[6 * k + 3], values[6 * k + 4], values[6 * k + 5]};
    const auto isFine = [](float v) { return v >= -kMostCellsOff && v <= kMostCellsOff; };
    if (cells[k] < 0 || cells[k] >= most || !isFine(e.x) || !isFine(e.y) || !isFine(e.xx) ||
        !isFine(e.xy) || !isFine(e.yy) || !(e.count >= 1.0F && e.count < 1e9F))
      refuse("surface_ends");
    std::int32_t& number = numberFor(cells[k] % grid_.columns, cells[k] / grid_.columns);
    if (number >= 0) refuse("surface_cells");
    number = static_cast<std::int32_t>(k);
    cells_.push_back(cells[k]);
    ends_.push_back(e);
  }
  makeSurfaces();
}

}  // namespace ortung

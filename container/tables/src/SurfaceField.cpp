#include "ortung/tables/SurfaceField.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
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

/// A cell with ends, and where it is, seen from the cell whose surface is wanted [cells].
template <class Ends>
struct Neighbour {
  const Ends* ends = nullptr;
  int column = 0;
  int row = 0;
  double weight = 0.0;
};

/// How ends lie around their mean [cells].
struct Spread {
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double across = 0.0;  ///< least standard deviation
  double along = 0.0;   ///< greatest one, at right angles to it

  bool isLine() const { return across < kLineRatio * along; }
};

/// Returns the spread of the ends of neighbours within @p radius.
template <class Ends>
Spread spreadOf(std::span<const Neighbour<Ends>> neighbours, int radius) {
  double n = 0.0;
  Spread all;
  for (const Neighbour<Ends>& one : neighbours) {
    if (std::abs(one.column) > radius || std::abs(one.row) > radius) continue;
    const Ends& ends = *one.ends;
    const double ex = static_cast<double>(ends.x) + one.column;
    const double ey = static_cast<double>(ends.y) + one.row;
    n += one.weight;
    all.x += one.weight * ex;
    all.y += one.weight * ey;
    all.xx += one.weight * (ex * ex + static_cast<double>(ends.xx));
    all.xy += one.weight * (ex * ey + static_cast<double>(ends.xy));
    all.yy += one.weight * (ey * ey + static_cast<double>(ends.yy));
  }
  all.x /= n;
  all.y /= n;
  all.xx = all.xx / n - all.x * all.x;
  all.xy = all.xy / n - all.x * all.y;
  all.yy = all.yy / n - all.y * all.y;
  const double middle = 0.5 * (all.xx + all.yy);
  const double apart = std::hypot(0.5 * (all.xx - all.yy), all.xy);
  all.across = std::sqrt(std::max(0.0, middle - apart));
  all.along = std::sqrt(std::max(0.0, middle + apart));
  return all;
}

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
  constexpr std::size_t kMost = (2 * kWidest + 1) * (2 * kWidest + 1);
  std::array<Neighbour<Ends>, kMost> found;
  std::size_t count = 0;
  double most = 0.0;
  for (int r = std::max(0, row - kWidest); r <= std::min(grid_.rows - 1, row + kWidest); ++r)
    for (int c = std::max(0, column - kWidest); c <= std::min(grid_.columns - 1, column + kWidest);
         ++c) {
      const std::int32_t other = numberAt(c, r);
      if (other < 0) continue;
      const Ends& ends = ends_[static_cast<std::size_t>(other)];
      most = std::max(most, static_cast<double>(ends.count));
      found[count++] = {&ends, c - column, r - row};
    }
  const std::span<Neighbour<Ends>> neighbours(found.data(), count);
  for (Neighbour<Ends>& one : neighbours)
    one.weight = std::min(1.0, static_cast<double>(one.ends->count) / (kFewEnds * most));
  Spread spread;
  for (int radius = kWidest; radius >= 0; --radius) {
    spread = spreadOf<Ends>(neighbours, radius);
    if (spread.isLine() && spread.across < kThickest) break;
  }
  Surface surface;
  // This is the direction of their least spread.
  const double angle = 0.5 * std::atan2(2.0 * spread.xy, spread.xx - spread.yy) + 0.25 * kTurn;
  surface.x = static_cast<float>(grid_.originX + (column + 0.5 + spread.x) * grid_.cell);
  surface.y = static_cast<float>(grid_.originY + (row + 0.5 + spread.y) * grid_.cell);
  surface.normalX = static_cast<float>(std::cos(angle));
  surface.normalY = static_cast<float>(std::sin(angle));
  surface.across =
      static_cast<float>(std::hypot(std::max(kThinnest, spread.across * grid_.cell), sigma_));
  surface.along =
      spread.isLine() ? -1.0F : static_cast<float>(std::max(kThinnest, spread.along * grid_.cell));
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
  std::vector<Offset> places;
  for (const std::int32_t cell : cells_)
    places.push_back({cell % grid_.columns, cell / grid_.columns});
  const auto isInside = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < grid_.columns && row < grid_.rows;
  };
  // A surface in the next cell on the way is nearer to all cells behind it. So by the signs of
  // offsets: surfaces that have none there, which are few along walls.
  std::array<std::vector<std::int32_t>, 9> outermost;
  const auto signs = [](int column, int row) {
    const auto sign = [](int n) { return (n > 0) - (n < 0); };
    return static_cast<std::size_t>(3 * sign(column) + sign(row) + 4);
  };
  const auto hasSurface = [&](int column, int row) {
    return isInside(column, row) && numberFor(column, row) >= 0;
  };
  for (std::size_t number = 0; number < places.size(); ++number) {
    const auto [column, row] = places[number];
    for (int c = -1; c <= 1; ++c)
      for (int r = -1; r <= 1; ++r)
        if ((c == 0 || !hasSurface(column + c, row)) && (r == 0 || !hasSurface(column, row + r)))
          outermost[signs(c, r)].push_back(static_cast<std::int32_t>(number));
  }
  for (const Offset& offset : offsets) {  // nearer ones come first
    for (const std::int32_t number : outermost[signs(offset.column, offset.row)]) {
      const int column = places[static_cast<std::size_t>(number)].column + offset.column;
      const int row = places[static_cast<std::size_t>(number)].row + offset.row;
      if (!isInside(column, row)) continue;
      std::int32_t& nearest = numberFor(column, row);
      if (nearest < 0) nearest = number;
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

std::shared_ptr<const SurfaceField> SurfaceField::of(const std::shared_ptr<const TableFile>& file,
                                                     const std::string& prefix) {
  return file->shared<SurfaceField>(prefix + "surfaces", [&] {
    auto surfaces = std::make_shared<SurfaceField>();
    surfaces->load(file, prefix);
    return surfaces;
  });
}

}  // namespace ortung

#include "ortung/mcl/MapChanges.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace ortung {
namespace {

constexpr std::int32_t kFarthest = 10'000'000;  // cells, 1e6 m

/// Tolerates the rounding of means.
bool isWithin(double at, std::int32_t number) {
  constexpr double kRounding = 1e-6;
  const double low = number * MapChanges::kCell;
  return at >= low - kRounding && at <= low + MapChanges::kCell + kRounding;
}

const char* wrongWith(const MapChange& change) {
  if (change.kind > MapChange::Kind::kNew) return "has no kind of change";
  if (change.column < -kFarthest || change.column >= kFarthest || change.row < -kFarthest ||
      change.row >= kFarthest)
    return "is farther away than 1e6 m";
  if (!isWithin(change.x, change.column) || !isWithin(change.y, change.row))
    return "has its middle elsewhere";
  if (change.passes == 0) return "was never found changed";
  if (change.lately > change.passes || change.days > change.passes || change.days == 0)
    return "has counts that don't fit together";
  return nullptr;
}

auto placeOf(const MapChange& change) { return std::tuple(change.kind, change.row, change.column); }

}  // namespace

std::size_t MapChanges::sure(MapChange::Kind kind) const {
  const auto isSure = [kind](const MapChange& cell) { return cell.isSure && cell.kind == kind; };
  return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), isSure));
}

void MapChanges::check() const {
  if (cells.size() > kMost)
    throw std::invalid_argument("there are " + std::to_string(cells.size()) +
                                " changed cells, expected at most " + std::to_string(kMost));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const char* wrong = wrongWith(cells[i]);
    if (wrong == nullptr && i > 0 && !(placeOf(cells[i - 1]) < placeOf(cells[i])))
      wrong = "does not come after the one before";
    if (wrong != nullptr)
      throw std::invalid_argument("changed cell " + std::to_string(i) + " " + wrong);
  }
}

}  // namespace ortung

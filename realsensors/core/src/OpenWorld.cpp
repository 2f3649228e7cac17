#include "ortung/realsensors/OpenWorld.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/NewFile.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostLandmarks = 256;  // as many as a [[sensor]] can see
constexpr double kFarthest = 1000.0;         // [m]; a world of this size still has a table

}  // namespace

void OpenWorld::read(const LogFile& file, std::uint32_t identity, std::size_t x, std::size_t step,
                     bool hasHeight) {
  const Range metres{-kFarthest, kFarthest};
  Place place{identity, file.number(x, "x [m]", metres), file.number(x + step, "y [m]", metres),
              std::nullopt};
  if (hasHeight) place.z = file.number(x + 2 * step, "z [m]", {0.0, 100.0});
  add(file, place);
}

void OpenWorld::add(const LogFile& file, std::uint32_t identity, double x, double y) {
  add(file, {identity, x, y, std::nullopt});
}

void OpenWorld::add(const LogFile& file, const Place& place) {
  if (has(place.identity))
    file.fail("landmark " + std::to_string(place.identity) + " twice", "each landmark once");
  if (landmarks_.size() == kMostLandmarks)
    file.fail("more landmarks", "at most " + std::to_string(kMostLandmarks));
  landmarks_.push_back(place);
}

bool OpenWorld::has(std::uint32_t identity) const {
  return std::any_of(landmarks_.begin(), landmarks_.end(),
                     [&](const Place& place) { return place.identity == identity; });
}

std::string OpenWorld::identities() const {
  std::string text;
  for (const Place& place : landmarks_)
    text += (text.empty() ? "" : ", ") + std::to_string(place.identity);
  return text;
}

OpenWorld::Bounds OpenWorld::bounds() const {
  Bounds bounds{1e9, -1e9, 1e9, -1e9};
  for (const Place& place : landmarks_) {
    bounds.xLow = std::min(bounds.xLow, place.x - margin_);
    bounds.xHigh = std::max(bounds.xHigh, place.x + margin_);
    bounds.yLow = std::min(bounds.yLow, place.y - margin_);
    bounds.yHigh = std::max(bounds.yHigh, place.y + margin_);
  }
  return bounds;
}

double OpenWorld::diagonal() const {
  if (isEmpty()) return 0.0;
  const Bounds b = bounds();
  return std::hypot(b.xHigh - b.xLow, b.yHigh - b.yLow);
}

void OpenWorld::write(const std::filesystem::path& file) const {
  if (isEmpty()) throw std::runtime_error(file.string() + ": the log has no landmark for a world");
  const Bounds b = bounds();
  std::string text = "[world]\nname = " + tomlText(file.stem().string()) + "\nx_m = [" +
                     tomlNumber(b.xLow) + ", " + tomlNumber(b.xHigh) + "]\ny_m = [" +
                     tomlNumber(b.yLow) + ", " + tomlNumber(b.yHigh) + "]\n";
  for (const Place& place : landmarks_) {
    text += "\n[[landmark]]\nkind = " + tomlText(kind_) +
            "\nidentity = " + std::to_string(place.identity) + "\nposition_m = [" +
            tomlNumber(place.x) + ", " + tomlNumber(place.y);
    if (place.z) text += ", " + tomlNumber(*place.z);
    text += "]\n";
  }
  writeFile(file, text);
}

}  // namespace ortung

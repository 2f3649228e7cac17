#include "BeliefFile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>

#include "ortung/tables/TableFile.hpp"

namespace ortung {
namespace {

constexpr const char* kWorld = "world.txt";
constexpr const char* kStamp = "stamp_us";
constexpr const char* kChanges = "changes";
constexpr const char* kMiddles = "changes_m";
constexpr std::size_t kNumbers = 9;  // of a changed cell
constexpr double kLatest = 9e15;     // up to here whole numbers are exact [us]: 285 years

std::vector<float> valuesOf(const TableFile& file, const char* name, std::size_t n) {
  const std::span<const float> values = file.get<float>(name, {n});
  return {values.begin(), values.end()};
}

bool anyStands(const SampleSet& samples, const FieldRegion& region) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::ptrdiff_t cell = region.grid.cellAt(samples.x[i], samples.y[i]);
    if (cell >= 0 && region.standable[static_cast<std::size_t>(cell)] != 0 &&
        std::isfinite(samples.logWeight[i]))
      return true;
  }
  return false;
}

std::int32_t limited(std::int64_t value) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(
      value, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()));
}

void addChanges(const MapChanges& changes, TableWriter& writer) {
  if (changes.cells.empty()) return;
  std::vector<std::int32_t> numbers;
  for (const MapChange& one : changes.cells)
    numbers.insert(numbers.end(), {static_cast<std::int32_t>(one.kind), one.column, one.row,
                                   limited(one.passes), limited(one.lately), limited(one.against),
                                   limited(one.days), limited(one.lastDay), one.isSure ? 1 : 0});
  writer.add<std::int32_t>(kChanges, {changes.cells.size(), kNumbers}, numbers);
  std::vector<double> middles;
  for (const MapChange& one : changes.cells) middles.insert(middles.end(), {one.x, one.y});
  writer.add<double>(kMiddles, {changes.cells.size(), 2}, middles);
}

}  // namespace

void writeBelief(const std::filesystem::path& file, const SavedBelief& saved,
                 const std::string& worldFingerprint) {
  const Belief& belief = saved.belief;
  const SampleSet& samples = belief.samples;
  const std::size_t n = samples.size();
  std::vector<float> theta;
  for (const float any : samples.theta) theta.push_back(static_cast<float>(wrapAngle(any)));
  const double stamp = std::clamp(static_cast<double>(belief.stamp), -kLatest, kLatest);
  TableWriter writer(file);
  writer.add<double>(kStamp, {1}, std::span(&stamp, 1));  // the first one says what the file is
  writer.addText(kWorld, worldFingerprint);
  writer.add<float>("x", {n}, samples.x);
  writer.add<float>("y", {n}, samples.y);
  writer.add<float>("theta", {n}, theta);
  writer.add<float>("logWeight", {n}, samples.logWeight);
  addChanges(saved.changes, writer);
  writer.commit();
}

MapChanges changesIn(const TableFile& file) {
  MapChanges changes;
  if (std::none_of(file.arrays().begin(), file.arrays().end(),
                   [](const TableArray& array) { return array.name == kChanges; }))
    return changes;
  const std::span<const std::int32_t> numbers = file.get<std::int32_t>(kChanges, {0, kNumbers});
  const std::span<const double> middles =
      file.get<double>(kMiddles, {numbers.size() / kNumbers, 2});
  const auto refuse = [&](const std::string& what) {
    throw TableError(file.path().string() + ": " + what);
  };
  if (numbers.size() / kNumbers > MapChanges::kMost)
    refuse("has " + std::to_string(numbers.size() / kNumbers) +
           " changed cells, expected at most " + std::to_string(MapChanges::kMost));
  for (std::size_t i = 0; i < numbers.size(); i += kNumbers) {
    const auto at = [&](std::size_t k) { return numbers[i + k]; };
    const auto count = [&](std::size_t k) { return static_cast<std::uint32_t>(at(k)); };
    const double* middle = middles.data() + 2 * (i / kNumbers);
    for (std::size_t k = 3; k < 7; ++k)
      if (at(k) < 0)
        refuse("changed cell " + std::to_string(i / kNumbers) + " has the count " +
               std::to_string(at(k)) + ", expected at least 0");
    if (at(0) < 0 || at(0) > 1)
      refuse("changed cell " + std::to_string(i / kNumbers) + " has the kind " +
             std::to_string(at(0)) + ", expected 0 or 1");
    changes.cells.push_back({static_cast<MapChange::Kind>(at(0)), at(1), at(2), middle[0],
                             middle[1], count(3), count(4), count(5), count(6), at(7), at(8) != 0});
  }
  try {
    changes.check();
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
  return changes;
}

std::string worldIn(const TableFile& file) { return file.text(kWorld); }

SavedBelief readBelief(const std::filesystem::path& path, const TableInfo& tables) {
  const TableFile file(path);
  const auto refuse = [&](const std::string& what) {
    throw TableError(path.string() + ": " + what);
  };
  const std::size_t n = file.get<float>("logWeight", {0}).size();
  SavedBelief saved;
  Belief& belief = saved.belief;
  belief.samples = {valuesOf(file, "x", n), valuesOf(file, "y", n), valuesOf(file, "theta", n),
                    valuesOf(file, "logWeight", n)};
  const double stamp = file.get<double>(kStamp, {1})[0];
  if (!(std::abs(stamp) <= kLatest))
    refuse("its stamp_us is " + std::to_string(stamp) + ", expected microseconds");
  belief.stamp = static_cast<Timestamp>(stamp);
  try {
    belief.check();
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
  saved.changes = changesIn(file);
  const std::string world = worldIn(file);
  if (world != tables.worldFingerprint)
    refuse("is a belief about the world '" + world + "', but the tables were learned in '" +
           tables.worldFingerprint + "' ('" + tables.world + "')");
  if (!anyStands(belief.samples, tables.region))
    refuse("none of its samples is where the robot can stand");
  return saved;
}

}  // namespace ortung

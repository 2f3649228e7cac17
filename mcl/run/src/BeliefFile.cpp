#include "BeliefFile.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "ortung/tables/TableFile.hpp"

namespace ortung {
namespace {

constexpr const char* kWorld = "world.txt";
constexpr const char* kStamp = "stamp_us";
constexpr double kLatest = 9e15;  // up to here whole numbers are exact [us]: 285 years

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

}  // namespace

void writeBelief(const std::filesystem::path& file, const Belief& belief,
                 const std::string& worldFingerprint) {
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
  writer.commit();
}

Belief readBelief(const std::filesystem::path& path, const TableInfo& tables) {
  const TableFile file(path);
  const auto refuse = [&](const std::string& what) {
    throw TableError(path.string() + ": " + what);
  };
  const std::size_t n = file.get<float>("logWeight", {0}).size();
  Belief belief;
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
  const std::string world = file.text(kWorld);
  if (world != tables.worldFingerprint)
    refuse("is a belief about the world '" + world + "', but the tables were learned in '" +
           tables.worldFingerprint + "' ('" + tables.world + "')");
  if (!anyStands(belief.samples, tables.region))
    refuse("none of its samples is where the robot can stand");
  return belief;
}

}  // namespace ortung

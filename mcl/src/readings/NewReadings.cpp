#include "NewReadings.hpp"

#include <algorithm>
#include <cmath>

#include "NominalTime.hpp"
#include "Parallel.hpp"

namespace ortung {
namespace {

constexpr float kMostNats = 1e4F;  ///< bound of one time step's |ln p|; ln 0 counts as -kMostNats

}  // namespace

PoseResolution coarsestOf(const std::vector<NewReading>& news) {
  PoseResolution coarsest;
  for (const NewReading& one : news) {
    const PoseResolution its = one.weigher->resolution();
    coarsest.metres = std::max(coarsest.metres, its.metres);
    coarsest.radians = std::max(coarsest.radians, its.radians);
  }
  return coarsest;
}

double nanosecondsOf(const std::vector<NewReading>& news) {
  double sum = 0.0;
  for (const NewReading& one : news) sum += nominalNanoseconds(*one.weigher);
  return sum;
}

void weigh(const std::vector<NewReading>& news, const SampleSet& set, Workers* workers,
           std::vector<float>& out) {
  out.assign(set.size(), 0.0F);
  forEachChunk(set.size(), workers, [&](std::size_t first, std::size_t count) {
    const SampleView part = set.view().part(first, count);
    const std::span<float> values = std::span(out).subspan(first, count);
    for (const NewReading& one : news) one.weigher->getProbability(part, values);
    // A plugin that returns ln 0 or NaN must not blind the filter for later readings.
    for (float& v : values)
      v = std::isfinite(v) ? std::clamp(v, -kMostNats, kMostNats) : -kMostNats;
  });
}

}  // namespace ortung

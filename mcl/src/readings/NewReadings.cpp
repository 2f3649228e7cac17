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

namespace {

/// Adds ln p of all readings to @p values.
void weighSome(const std::vector<NewReading>& news, const SampleView& some,
               std::span<float> values) {
  for (const NewReading& one : news) one.weigher->getProbability(some, values);
  // A plugin that returns ln 0 or NaN must not blind the filter for later readings.
  for (float& v : values) v = std::isfinite(v) ? std::clamp(v, -kMostNats, kMostNats) : -kMostNats;
}

/// Weighs every @p step-th sample from @p first on.
void weighSpread(const std::vector<NewReading>& news, const SampleSet& set, std::size_t first,
                 std::size_t step, std::span<float> out) {
  SampleSet some;
  some.resize((set.size() - first + step - 1) / step);
  for (std::size_t k = 0; k < some.size(); ++k) {
    some.x[k] = set.x[first + k * step];
    some.y[k] = set.y[first + k * step];
    some.theta[k] = set.theta[first + k * step];
  }
  weighSome(news, some.view(), some.logWeight);
  for (std::size_t k = 0; k < some.size(); ++k) out[first + k * step] = some.logWeight[k];
}

}  // namespace

void weigh(const std::vector<NewReading>& news, const SampleSet& set, Workers* workers,
           std::vector<float>& out) {
  out.assign(set.size(), 0.0F);
  forEachChunk(set.size(), workers, [&](std::size_t first, std::size_t count) {
    weighSome(news, set.view().part(first, count), std::span(out).subspan(first, count));
  });
}

Parts weighUntil(const IsOver& isOver, const std::vector<NewReading>& news, const SampleSet& set,
                 Workers& workers, std::size_t atOnce, std::vector<float>& out) {
  out.resize(set.size());
  Parts parts{std::max<std::size_t>(1, (set.size() + kTimedPoses - 1) / kTimedPoses), 0};
  while (parts.weighed < parts.all) {
    const std::size_t some = std::min(atOnce, parts.all - parts.weighed);
    forEach(some, &workers,
            [&](std::size_t k) { weighSpread(news, set, parts.weighed + k, parts.all, out); });
    parts.weighed += some;
    if (isNow(isOver)) break;
  }
  return parts;
}

}  // namespace ortung

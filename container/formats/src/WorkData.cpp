#include "ortung/formats/WorkData.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ortung {
namespace {

constexpr double kMicro = 1e6;

SensorId ownId() { return {"mcl", "LOCALIZATION", "work"}; }

/// Returns the value, rounded and clamped; 0 for NaN.
std::uint32_t wordOf(double value) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  if (std::isnan(value)) return 0;
  return static_cast<std::uint32_t>(std::nearbyint(std::clamp(value, 0.0, kMost)));
}

}  // namespace

WorkData::WorkData() : SensorData(ownId()) {}
WorkData::~WorkData() = default;

std::vector<std::uint32_t> WorkData::encode(const Reading& reading) {
  return {wordOf(static_cast<double>(reading.samples)), wordOf(reading.effectiveSamples),
          wordOf(reading.seconds * kMicro), static_cast<std::uint32_t>(reading.estimates)};
}

Message WorkData::message(Timestamp stamp, const Reading& reading) {
  return {stamp, ownId(), encode(reading)};
}

Format WorkData::format() const { return Format(kFormat); }

std::string WorkData::wordsHelp() const {
  return "[samples, their worth in equal samples, duration of the newest update us, estimates so "
         "far] of mcl/LOCALIZATION/pose";
}

void WorkData::check(std::span<const std::uint32_t> words) const {
  if (words.size() != 4)
    throw std::invalid_argument("found " + std::to_string(words.size()) + " words, expected 4");
  if (words[1] > words[0])
    throw std::invalid_argument("found " + std::to_string(words[0]) + " samples worth " +
                                std::to_string(words[1]) + ", expected no more than there are");
}

void WorkData::decode(std::span<const std::uint32_t> words) {
  reading_ = {words[0], static_cast<double>(words[1]), words[2] / kMicro, words[3]};
}

}  // namespace ortung

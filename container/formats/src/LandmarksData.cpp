#include "ortung/formats/LandmarksData.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "FormatTools.hpp"
#include "LandmarkExpectations.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWordsASighting = 3;
constexpr std::size_t kMostSightings = 4096;

}  // namespace

LandmarksData::LandmarksData(SensorId id, const Pose2& mount, Config config)
    : LearnedData(std::move(id), mount, std::make_unique<LandmarkExpectations>(*this, config)),
      config_(std::move(config)) {
  std::vector<std::uint32_t> sorted = config_.identities;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    throw std::invalid_argument("the landmarks' identities must be at least one and unique");
  }
}

LandmarksData::~LandmarksData() = default;

LandmarksData::Config LandmarksData::configOf(const Format&, std::span<const std::uint32_t> words) {
  std::set<std::uint32_t> identities;
  for (std::size_t i = 0; i < words.size(); i += kWordsASighting) identities.insert(words[i]);
  if (identities.empty()) identities.insert(0);
  return {.identities = {identities.begin(), identities.end()}, .range = {}};
}

std::vector<std::uint32_t> LandmarksData::encode(const Reading& reading) {
  std::vector<std::uint32_t> out;
  encode(reading, out);
  return out;
}

void LandmarksData::encode(const Reading& reading, std::vector<std::uint32_t>& out) {
  out.clear();
  out.reserve(reading.size() * kWordsASighting);
  for (const Sighting& sighting : reading) {
    out.push_back(sighting.identity);
    out.push_back(words::fromMetres(sighting.range));
    out.push_back(words::fromAngle(sighting.bearing));
  }
}

void LandmarksData::check(std::span<const std::uint32_t> words) const {
  checkEntries(words, kWordsASighting, kMostSightings,
               "three a sighting and at most 4096 sightings");
  for (std::size_t i = 2; i < words.size(); i += kWordsASighting) checkAngleWord(words[i]);
}

void LandmarksData::decode(std::span<const std::uint32_t> words) {
  reading_.clear();
  for (std::size_t i = 0; i < words.size(); i += kWordsASighting) {
    reading_.push_back({words[i], words::toMetres(words[i + 1]), words::toAngle(words[i + 2])});
  }
}

Format LandmarksData::format() const { return Format(kFormat); }

std::string LandmarksData::wordsHelp() const {
  return "[identity, distance mm, bearing 1/100 degree + 18000] a landmark in sight, or none: "
         "looked and saw nothing";
}

LandmarksData::Sighting LandmarksData::corrected(const Sighting& sighting) const {
  const auto [range, bearing] = config_.bias.corrected({sighting.range, sighting.bearing});
  return {sighting.identity, range, bearing};
}

std::ptrdiff_t LandmarksData::indexOf(std::uint32_t identity) const {
  const auto it = std::find(config_.identities.begin(), config_.identities.end(), identity);
  return it == config_.identities.end() ? -1 : it - config_.identities.begin();
}

std::ptrdiff_t LandmarksData::indexOf(const Sighting& sighting, const Pose2& pose) const {
  if (config_.identified || sighting.identity != kUnknown) return indexOf(sighting.identity);
  const LandmarkPlaces& places = static_cast<const LandmarkExpectations&>(expectations()).places();
  if (places.isEmpty()) return -1;
  const Pose2 sensor = pose * mount();
  const Sighting truly = corrected(sighting);
  const double angle = sensor.theta + truly.bearing;
  const std::uint16_t which = places.nearestTo(sensor.x + truly.range * std::cos(angle),
                                               sensor.y + truly.range * std::sin(angle));
  return which == LandmarkPlaces::kNone ? -1 : which;
}

std::vector<double> LandmarksData::measured(const Pose2& pose) const {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> measured(2 * config_.identities.size(), kNothing);
  for (const Sighting& sighting : reading_) {
    const std::ptrdiff_t found = indexOf(sighting, pose);
    if (found < 0) continue;
    const Sighting truly = corrected(sighting);
    measured[2 * static_cast<std::size_t>(found)] = truly.range;
    measured[2 * static_cast<std::size_t>(found) + 1] = truly.bearing;
  }
  return measured;
}

std::vector<WordValue> LandmarksData::valuesIn(std::span<const std::uint32_t> words) const {
  std::vector<WordValue> values;
  const double half = halfViewOf(config_.fieldOfView);
  for (std::size_t i = 0; i + kWordsASighting <= words.size(); i += kWordsASighting) {
    const std::size_t entry = i / kWordsASighting;
    values.push_back({i, entry, ValueKind::kIdentity, static_cast<double>(indexOf(words[i])), 0.0,
                      static_cast<double>(config_.identities.size())});
    values.push_back(
        {i + 1, entry, ValueKind::kRange, words::toMetres(words[i + 1]), 0.0, config_.maxRange});
    values.push_back(
        {i + 2, entry, ValueKind::kBearing, words::toAngle(words[i + 2]), -half, half});
  }
  return values;
}

/// Stores a value; that of an identity is its place in the list.
void LandmarksData::store(const WordValue& value, std::span<std::uint32_t> words) const {
  if (value.kind != ValueKind::kIdentity) return SensorData::store(value, words);
  if (!(value.value >= 0.0)) return;  // an identity that is not in the list stays as it is
  const auto index = static_cast<std::size_t>(value.value);
  words[value.word] = config_.identities[std::min(index, config_.identities.size() - 1)];
}

}  // namespace ortung

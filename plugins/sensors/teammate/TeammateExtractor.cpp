#include "TeammateExtractor.hpp"

#include <algorithm>
#include <stdexcept>

#include "FusedFixes.hpp"

namespace ortung {
namespace {

// Indices of the features of the device.
constexpr std::size_t kPosition = 0;
constexpr std::size_t kRobots = 1;
constexpr std::size_t kBalls = 2;

/// Greatest number of remembered reports; more are not plausible.
constexpr std::size_t kMostMates = 256;

}  // namespace

std::vector<std::string> TeammateExtractor::inputs() const {
  return {toText({settings_.id.model, settings_.id.type, TeammateSettings::kTalk})};
}

void TeammateExtractor::take(std::span<const SensorData* const> inputs) {
  auto talk = readingAs<TalkData>(*inputs[0]);
  if (!talk) throw std::invalid_argument(toText(inputs[0]->id()) + " is not talk, expected some");
  talk_ = *std::move(talk);
  if (inputs[0]->stamp() < now_) {  // the clock was reset
    robots_.clear();
    balls_.clear();
  }
  now_ = inputs[0]->stamp();
}

/// Remembers a report. A robot's report of itself is better than what others see of it.
void TeammateExtractor::remember(Memory& memory, Known known, const std::string& source) {
  const std::string& name = known.told.place.name;
  const auto found = memory.find({name, source});
  if (found == memory.end()) {
    if (memory.size() < kMostMates) memory.emplace(std::pair(name, source), std::move(known));
    return;
  }
  const bool isOwn = known.told.from == name;
  const bool wasOwn = found->second.told.from == name;
  const bool isStale = now_ - found->second.said > fromSeconds(settings_.keep);
  if (isOwn || !wasOwn || isStale) found->second = std::move(known);
}

PlacesData::Reading TeammateExtractor::recall(Memory& memory) const {
  std::erase_if(memory, [&](const auto& entry) {
    return now_ - entry.second.said > fromSeconds(settings_.keep);
  });
  PlacesData::Reading reading;
  for (auto& [key, known] : memory) {
    known.told.age = toSeconds(now_ - known.said);
    reading.push_back(known.told);
  }
  return reading;
}

void TeammateExtractor::extract(const FieldModel&, std::span<std::optional<Words>> words) {
  std::map<std::string, PoseFixData::Fix> sightings;  ///< sightings of this robot, by observer
  bool isOfRobots = false;
  bool isOfBalls = false;
  for (const TalkData::Message& message : talk_.messages) {
    std::optional<Place> place = placeIn(message.text);
    if (!place) continue;
    const std::string name = place->name;
    Known known{{std::move(*place), message.age, message.from}, now_ - fromSeconds(message.age)};
    if (known.told.place.kind == Place::Kind::kBall) {
      remember(balls_, std::move(known), message.from);
      isOfBalls = true;
    } else if (name == talk_.listener) {
      sightings[message.from] = known.told.place.fix;
    } else {
      remember(robots_, std::move(known), "");
      isOfRobots = true;
    }
  }
  std::vector<PoseFixData::Fix> fixes;
  for (const auto& [mate, fix] : sightings) fixes.push_back(fix);
  if (!fixes.empty()) words[kPosition] = PoseFixData::encode(fused(fixes, settings_.fix));
  if (isOfRobots) words[kRobots] = PlacesData::encode(recall(robots_));
  if (isOfBalls) words[kBalls] = PlacesData::encode(recall(balls_));
}

}  // namespace ortung

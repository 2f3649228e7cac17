#include "ortung/formats/TrackData.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/formats/FormatNames.hpp"

namespace ortung {
namespace {

constexpr std::uint32_t kOne = 10'000;
constexpr auto kLastStatus = static_cast<std::uint32_t>(TrackStatus::kLast);
constexpr auto kLastReason = static_cast<std::uint32_t>(TrackReason::kLast);

SensorId ownId() { return {"mcl", "LOCALIZATION", "status"}; }

/// Returns the word of a share; 0 for NaN.
std::uint32_t shareWord(double share) {
  if (std::isnan(share)) return 0;
  return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kOne));
}

/// Returns the names of all values of an enumeration, in their order.
template <class Enumeration>
std::vector<const char*> namesOf() {
  std::vector<const char*> names;
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(Enumeration::kLast); ++i)
    names.push_back(nameOf(static_cast<Enumeration>(i)));
  return names;
}

void checkBelow(const char* what, std::uint32_t word, std::uint32_t most) {
  if (word <= most) return;
  throw std::invalid_argument("found the " + std::string(what) + " " + std::to_string(word) +
                              ", expected 0 to " + std::to_string(most));
}

}  // namespace

TrackData::TrackData() : SensorData(ownId()) {}
TrackData::~TrackData() = default;

std::vector<std::uint32_t> TrackData::encode(const Reading& reading) {
  return {static_cast<std::uint32_t>(reading.status), static_cast<std::uint32_t>(reading.reason),
          shareWord(reading.quality), shareWord(reading.share)};
}

Message TrackData::message(Timestamp stamp, const Reading& reading) {
  return {stamp, ownId(), encode(reading)};
}

Format TrackData::format() const {
  return Format(formats::kTrack)
      .with("status", namesOf<TrackStatus>())
      .with("reason", namesOf<TrackReason>());
}

std::string TrackData::wordsHelp() const {
  std::string text = "[status (";
  for (std::uint32_t i = 0; i <= kLastStatus; ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " " + nameOf(static_cast<TrackStatus>(i));
  text += "), reason (";
  for (std::uint32_t i = 0; i <= kLastReason; ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " " + nameOf(static_cast<TrackReason>(i));
  return text +
         "), probability of an error below 0.5 m 1/10000, share of the belief 1/10000] of "
         "mcl/LOCALIZATION/pose";
}

void TrackData::check(std::span<const std::uint32_t> words) const {
  if (words.size() != 4)
    throw std::invalid_argument("found " + std::to_string(words.size()) + " words, expected 4");
  checkBelow("status", words[0], kLastStatus);
  checkBelow("reason", words[1], kLastReason);
  checkBelow("quality", words[2], kOne);
  checkBelow("share", words[3], kOne);
}

void TrackData::decode(std::span<const std::uint32_t> words) {
  reading_ = {static_cast<TrackStatus>(words[0]), static_cast<TrackReason>(words[1]),
              static_cast<double>(words[2]) / kOne, static_cast<double>(words[3]) / kOne};
}

}  // namespace ortung

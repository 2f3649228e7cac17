#include "ortung/formats/TrackData.hpp"

#include "FormatTools.hpp"
#include "ShareWords.hpp"

namespace ortung {
namespace {

constexpr auto kLastStatus = static_cast<std::uint32_t>(TrackStatus::kLast);
constexpr auto kLastReason = static_cast<std::uint32_t>(TrackReason::kLast);

SensorId ownId() { return {"mcl", "LOCALIZATION", "status"}; }

/// Returns the names of all values of an enumeration, in their order.
template <class Enumeration>
std::vector<const char*> namesOf() {
  std::vector<const char*> names;
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(Enumeration::kLast); ++i)
    names.push_back(nameOf(static_cast<Enumeration>(i)));
  return names;
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
  return Format(kFormat)
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
  checkWordCount(words, 4);
  checkAtMost("status", words[0], kLastStatus);
  checkAtMost("reason", words[1], kLastReason);
  checkAtMost("quality", words[2], kWholeShare);
  checkAtMost("share", words[3], kWholeShare);
}

void TrackData::decode(std::span<const std::uint32_t> words) {
  reading_ = {static_cast<TrackStatus>(words[0]), static_cast<TrackReason>(words[1]),
              shareOf(words[2]), shareOf(words[3])};
}

}  // namespace ortung

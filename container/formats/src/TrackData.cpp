#include "ortung/formats/TrackData.hpp"

#include "FormatTools.hpp"
#include "ShareWords.hpp"

namespace ortung {
namespace {

constexpr auto kLastStatus = static_cast<std::uint32_t>(TrackStatus::kLast);
constexpr auto kLastReason = static_cast<std::uint32_t>(TrackReason::kLast);
constexpr auto kLastCause = static_cast<std::uint32_t>(Relocalization::kLast);
constexpr std::size_t kWords = 6;
constexpr std::size_t kWordsOfOlder = 4;  // without relocalizations

SensorId ownId() { return {"mcl", "LOCALIZATION", "status"}; }

/// Returns the names of all values of an enumeration, in their order.
template <class Enumeration>
std::vector<const char*> namesOf() {
  std::vector<const char*> names;
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(Enumeration::kLast); ++i)
    names.push_back(nameOf(static_cast<Enumeration>(i)));
  return names;
}

/// Returns "0 tracking, 1 uncertain, ...".
template <class Enumeration>
std::string numbered() {
  const std::vector<const char*> names = namesOf<Enumeration>();
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " " + names[i];
  return text;
}

}  // namespace

TrackData::TrackData() : SensorData(ownId()) {}
TrackData::~TrackData() = default;

std::vector<std::uint32_t> TrackData::encode(const Reading& reading) {
  return {static_cast<std::uint32_t>(reading.status),
          static_cast<std::uint32_t>(reading.reason),
          shareWord(reading.quality),
          shareWord(reading.share),
          reading.relocalizations,
          static_cast<std::uint32_t>(reading.relocalization)};
}

Message TrackData::message(Timestamp stamp, const Reading& reading) {
  return {stamp, ownId(), encode(reading)};
}

Format TrackData::format() const {
  return Format(kFormat)
      .with("status", namesOf<TrackStatus>())
      .with("reason", namesOf<TrackReason>())
      .with("cause", namesOf<Relocalization>());
}

std::string TrackData::wordsHelp() const {
  return "[status (" + numbered<TrackStatus>() + "), reason (" + numbered<TrackReason>() +
         "), probability of an error below 0.5 m 1/10000, share of the belief 1/10000, "
         "relocalizations, cause of the newest (" +
         numbered<Relocalization>() + ")] of mcl/LOCALIZATION/pose";
}

void TrackData::check(std::span<const std::uint32_t> words) const {
  if (words.size() != kWordsOfOlder) checkWordCount(words, kWords);
  checkAtMost("status", words[0], kLastStatus);
  checkAtMost("reason", words[1], kLastReason);
  checkAtMost("quality", words[2], kWholeShare);
  checkAtMost("share", words[3], kWholeShare);
  if (words.size() == kWords) checkAtMost("cause", words[5], kLastCause);
}

void TrackData::decode(std::span<const std::uint32_t> words) {
  reading_ = {static_cast<TrackStatus>(words[0]), static_cast<TrackReason>(words[1]),
              shareOf(words[2]), shareOf(words[3])};
  if (words.size() != kWords) return;
  reading_.relocalizations = words[4];
  reading_.relocalization = static_cast<Relocalization>(words[5]);
}

}  // namespace ortung

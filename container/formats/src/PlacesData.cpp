#include "ortung/formats/PlacesData.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "FixWords.hpp"
#include "FormatTools.hpp"
#include "TextWords.hpp"
#include "ortung/formats/TalkData.hpp"

namespace ortung {
namespace {

constexpr double kMicro = 1e6;  ///< per second

void checkName(const std::string& name) {
  if (!isName(name))
    throw std::invalid_argument("found a place of '" + name +
                                "', expected a name of 1 to 64 characters of [A-Za-z0-9_.-]");
}

PlacesData::Reading readPlaces(std::span<const std::uint32_t> words) {
  PlacesData::Reading reading;
  WordsReader reader(words);
  while (!reader.isAtEnd()) {
    if (reading.size() == PlacesData::kMostPlaces)
      throw std::invalid_argument("found more places than the 256 that were expected at most");
    PlacesData::Told told;
    const std::uint32_t kind = reader.word();
    if (kind > 1)
      throw std::invalid_argument("found the kind " + std::to_string(kind) +
                                  ", expected 0 for a robot or 1 for a ball");
    told.place.kind = static_cast<Place::Kind>(kind);
    told.place.name = reader.text("a place's name", TalkData::kLongestName);
    checkName(told.place.name);
    told.from = reader.text("a speaker", TalkData::kLongestName);
    told.age = reader.word() / kMicro;
    const auto fix = reader.take(kWordsAFix);
    checkFixWords(fix);
    told.place.fix = fixIn(fix);
    reading.push_back(std::move(told));
  }
  return reading;
}

}  // namespace

PlacesData::PlacesData(SensorId id) : SensorData(std::move(id)) {}
PlacesData::~PlacesData() = default;

std::vector<std::uint32_t> PlacesData::encode(const Reading& reading) {
  if (reading.size() > kMostPlaces)
    throw std::invalid_argument("found " + std::to_string(reading.size()) +
                                " places, expected at most 256");
  std::vector<std::uint32_t> words;
  for (const Told& told : reading) {
    checkName(told.place.name);
    checkText("a speaker", told.from, TalkData::kLongestName);
    words.push_back(static_cast<std::uint32_t>(told.place.kind));
    addTextWords(told.place.name, words);
    addTextWords(told.from, words);
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    words.push_back(
        static_cast<std::uint32_t>(std::clamp(std::nearbyint(told.age * kMicro), 0.0, kMost)));
    addFixWords(told.place.fix, words);
  }
  return words;
}

void PlacesData::check(std::span<const std::uint32_t> words) const { readPlaces(words); }
void PlacesData::decode(std::span<const std::uint32_t> words) { reading_ = readPlaces(words); }

Format PlacesData::format() const { return Format(kFormat); }

std::string PlacesData::wordsHelp() const {
  return "[0 robot or 1 ball, name, who said it, us ago, nine words of a fix] a place; a text is "
         "its number of bytes and these, four a word";
}

}  // namespace ortung

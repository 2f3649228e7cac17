#include "ortung/formats/ProtectionData.hpp"

#include <algorithm>
#include <cmath>

#include "FormatTools.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr std::uint32_t kUnboundedWord = std::numeric_limits<std::uint32_t>::max();
constexpr double kWordsPerMetre = 1e6;
constexpr double kWordsPerRadian = 1e4 * 360.0 / kTurn;

SensorId ownId() { return {"mcl", "LOCALIZATION", "protection"}; }

/// Returns the word of a bound: never less than it is, but for what rounding made of a word.
std::uint32_t wordOf(double bound, double wordsPerUnit) {
  constexpr double kOfRounding = 1e-6;
  const double words = std::ceil(bound * wordsPerUnit - kOfRounding);
  if (!(words < kUnboundedWord)) return kUnboundedWord;  // NaN bounds nothing
  return static_cast<std::uint32_t>(std::max(0.0, words));
}

double boundOf(std::uint32_t word, double wordsPerUnit) {
  return word == kUnboundedWord ? std::numeric_limits<double>::infinity() : word / wordsPerUnit;
}

}  // namespace

ProtectionData::ProtectionData() : SensorData(ownId()) {}
ProtectionData::~ProtectionData() = default;

std::vector<std::uint32_t> ProtectionData::encode(const Reading& reading) {
  return {wordOf(reading.metres, kWordsPerMetre), wordOf(reading.radians, kWordsPerRadian)};
}

Message ProtectionData::message(Timestamp stamp, const Reading& reading) {
  return {stamp, ownId(), encode(reading)};
}

Format ProtectionData::format() const { return Format(kFormat); }

std::string ProtectionData::wordsHelp() const {
  return "[radius um, angle 1/10000 deg that the error of mcl/LOCALIZATION/pose exceeds once in "
         "1000 while tracking and once in 100 while uncertain; 4294967295: unbounded]";
}

void ProtectionData::check(std::span<const std::uint32_t> words) const { checkWordCount(words, 2); }

void ProtectionData::decode(std::span<const std::uint32_t> words) {
  reading_ = {boundOf(words[0], kWordsPerMetre), boundOf(words[1], kWordsPerRadian)};
}

}  // namespace ortung

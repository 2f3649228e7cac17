#include "ortung/formats/SamplesData.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/base/Angles.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWords = 4;  // words of one sample
constexpr std::uint32_t kHeaviest = 65'535;
constexpr double kHundredths = 36'000.0 / kTurn;  // hundredths of a degree per radian

SensorId ownId() { return {"mcl", "LOCALIZATION", "samples"}; }

std::uint32_t headingWord(double theta) {
  const double whole = std::nearbyint(wrapAngle(theta) * kHundredths);
  return static_cast<std::uint32_t>(whole < 0.0 ? whole + words::kAngles : whole) % words::kAngles;
}

std::uint32_t weightWord(double share) {
  if (std::isnan(share)) return 0;
  return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kHeaviest));
}

}  // namespace

SamplesData::SamplesData() : SensorData(ownId()) {}
SamplesData::~SamplesData() = default;

std::vector<std::uint32_t> SamplesData::encode(std::span<const Sample> samples) {
  std::vector<std::uint32_t> words;
  words.reserve(kWords * std::min(samples.size(), kMostSamples));
  for (const Sample& one : samples.first(std::min(samples.size(), kMostSamples)))
    words.insert(words.end(),
                 {words::fromSignedMetres(one.pose.x), words::fromSignedMetres(one.pose.y),
                  headingWord(one.pose.theta), weightWord(one.weight)});
  return words;
}

Message SamplesData::message(Timestamp stamp, std::span<const Sample> samples) {
  return {stamp, ownId(), encode(samples)};
}

SamplesData::Reading SamplesData::reading() const {
  Reading reading;
  const std::span<const std::uint32_t> words = getData();
  for (std::size_t i = 0; i + kWords <= words.size(); i += kWords)
    reading.push_back({{words::toSignedMetres(words[i]), words::toSignedMetres(words[i + 1]),
                        wrapAngle(words[i + 2] / kHundredths)},
                       static_cast<double>(words[i + 3]) / kHeaviest});
  return reading;
}

Format SamplesData::format() const { return Format(kFormat); }

std::string SamplesData::wordsHelp() const {
  return "[x mm + 2^31, y mm + 2^31, heading 1/100 degree, weight of the heaviest's 1/65535] a "
         "sample of mcl/LOCALIZATION/pose; only while a client asks for it by its name";
}

void SamplesData::check(std::span<const std::uint32_t> words) const {
  if (words.size() % kWords != 0 || words.size() > kWords * kMostSamples)
    throw std::invalid_argument("found " + std::to_string(words.size()) +
                                " words, expected four a sample and at most " +
                                std::to_string(kMostSamples) + " samples");
  for (std::size_t i = 0; i < words.size(); i += kWords) {
    if (words[i + 2] >= words::kAngles)
      throw std::invalid_argument("found the heading " + std::to_string(words[i + 2]) +
                                  ", expected below 36000");
    if (words[i + 3] > kHeaviest)
      throw std::invalid_argument("found the weight " + std::to_string(words[i + 3]) +
                                  ", expected 0 to 65535");
  }
}

}  // namespace ortung

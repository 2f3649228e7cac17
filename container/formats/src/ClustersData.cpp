#include "ortung/formats/ClustersData.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/formats/FormatNames.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWords = 10;  // words of one place
constexpr std::uint32_t kOne = 10'000;

SensorId ownId() { return {"mcl", "LOCALIZATION", "places"}; }

std::uint32_t shareWord(double share) {
  if (std::isnan(share)) return 0;
  return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kOne));
}

/// Returns the fixes without their shares, in the format of fixes.
std::vector<std::uint32_t> fixWords(std::span<const std::uint32_t> words) {
  std::vector<std::uint32_t> fixes;
  for (std::size_t i = 0; i < words.size(); i += kWords)
    fixes.insert(fixes.end(), words.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                 words.begin() + static_cast<std::ptrdiff_t>(i + kWords));
  return fixes;
}

}  // namespace

ClustersData::ClustersData() : SensorData(ownId()), fixes_(ownId(), {}) {}
ClustersData::~ClustersData() = default;

std::vector<std::uint32_t> ClustersData::encode(std::span<const Cluster> places) {
  std::vector<std::uint32_t> words;
  for (const Cluster& place : places.first(std::min(places.size(), kMostClusters))) {
    words.push_back(shareWord(place.share));
    const std::vector<std::uint32_t> its = PoseFixData::encode(std::span(&place.fix, 1));
    words.insert(words.end(), its.begin(), its.end());
  }
  return words;
}

Message ClustersData::message(Timestamp stamp, std::span<const Cluster> places) {
  return {stamp, ownId(), encode(places)};
}

Format ClustersData::format() const { return Format(formats::kClusters); }

std::string ClustersData::wordsHelp() const {
  return "[share of the belief 1/10000, then the nine words of mcl/LOCALIZATION/pose] a place "
         "where the robot may be, heaviest first";
}

void ClustersData::check(std::span<const std::uint32_t> words) const {
  if (words.size() % kWords != 0 || words.size() > kWords * kMostClusters)
    throw std::invalid_argument("found " + std::to_string(words.size()) +
                                " words, expected ten a place and at most " +
                                std::to_string(kMostClusters) + " places");
  for (std::size_t i = 0; i < words.size(); i += kWords)
    if (words[i] > kOne)
      throw std::invalid_argument("found the share " + std::to_string(words[i]) +
                                  ", expected 0 to 10000");
  fixes_.checkData(fixWords(words));
}

void ClustersData::decode(std::span<const std::uint32_t> words) {
  fixes_.setData(0, fixWords(words));
  reading_.clear();
  for (std::size_t i = 0; i < fixes_.reading().size(); ++i)
    reading_.push_back({static_cast<double>(words[i * kWords]) / kOne, fixes_.reading()[i]});
}

}  // namespace ortung

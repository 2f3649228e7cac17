#include "ortung/formats/ClustersData.hpp"

#include <algorithm>

#include "FormatTools.hpp"
#include "ShareWords.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWords = 10;  // words of one place

SensorId ownId() { return {"mcl", "LOCALIZATION", "places"}; }

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

Format ClustersData::format() const { return Format(kFormat); }

std::string ClustersData::wordsHelp() const {
  return "[share of the belief 1/10000, then the nine words of mcl/LOCALIZATION/pose] a place "
         "where the robot may be, heaviest first";
}

void ClustersData::check(std::span<const std::uint32_t> words) const {
  static_assert(kMostClusters == 64);
  checkEntries(words, kWords, kMostClusters, "ten a place and at most 64 places");
  for (std::size_t i = 0; i < words.size(); i += kWords)
    checkAtMost("share", words[i], kWholeShare);
  fixes_.checkData(fixWords(words));
}

void ClustersData::decode(std::span<const std::uint32_t> words) {
  fixes_.setData(0, fixWords(words));
  reading_.clear();
  for (std::size_t i = 0; i < fixes_.reading().size(); ++i)
    reading_.push_back({shareOf(words[i * kWords]), fixes_.reading()[i]});
}

}  // namespace ortung

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/PoseFixData.hpp"

namespace ortung {

/// The places that a localization's belief is spread over, heaviest first: the feature
/// mcl/LOCALIZATION/places (LocalizationConfig::publish), as Mcl::places() tells them.
/// Ten words a place: its share of the belief [1/10000], then the nine words of PoseFixData. It
/// only reports, so it weighs no samples. Not thread-safe, see SensorData.
class ORTUNG_API ClustersData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kClusters;
  struct Cluster {
    double share = 0.0;    ///< share of the belief, in [0, 1]
    PoseFixData::Fix fix;  ///< mean and covariance of the place
  };
  using Reading = std::vector<Cluster>;
  static constexpr std::size_t kMostClusters = PoseFixData::kMostFixes;

  ClustersData();
  ~ClustersData() override;
  const Reading& reading() const { return reading_; }
  /// Returns the words of the first kMostClusters places.
  static std::vector<std::uint32_t> encode(std::span<const Cluster> places);
  static Message message(Timestamp stamp, std::span<const Cluster> places);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  PoseFixData fixes_;  ///< decoder of the fixes, without their shares
  Reading reading_;
};

}  // namespace ortung

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/TrackStatus.hpp"

namespace ortung {

/// How far a localization's estimate can be relied on, for other programs: the feature
/// mcl/LOCALIZATION/status beside mcl/LOCALIZATION/pose (LocalizationConfig::publish).
/// Words: status (0 tracking, 1 uncertain, 2 lost), reason (in the order of TrackReason), quality
/// and share [1/10000], both in [0, 1], number of relocalizations so far, cause of the newest one
/// (in the order of Relocalization). Older records end after the share. It only reports, so it
/// weighs no samples.
/// Not thread-safe, see SensorData.
class ORTUNG_API TrackData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kTrack;
  struct Reading {
    TrackStatus status = TrackStatus::kLost;
    TrackReason reason = TrackReason::kNoReading;
    double quality = 0.0;  ///< probability that the position error is below 0.5 m, in [0, 1]
    double share = 0.0;    ///< share of the estimate's cluster in the whole belief, in [0, 1]
    std::uint32_t relocalizations = 0;                      ///< see PoseEstimate
    Relocalization relocalization = Relocalization::kNone;  ///< cause of the newest one
  };

  TrackData();
  ~TrackData() override;
  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);
  static Message message(Timestamp stamp, const Reading& reading);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading reading_;
};

}  // namespace ortung

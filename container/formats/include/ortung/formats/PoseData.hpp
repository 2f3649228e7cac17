#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// A pose in the field frame, e.g. ground truth (type "groundTruth"). Words: x, y [signed mm],
/// [angle]. Not thread-safe, see SensorData.
class ORTUNG_API PoseData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kPose;
  using Reading = Pose2;
  explicit PoseData(SensorId id);
  ~PoseData() override;
  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Pose2& pose);
  static void encode(const Pose2& pose, std::vector<std::uint32_t>& words);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Pose2 reading_;
};

}  // namespace ortung

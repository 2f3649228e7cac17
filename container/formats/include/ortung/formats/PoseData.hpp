#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// A pose in the field frame, e.g. ground truth (type "groundTruth"). Words: x, y [signed mm],
/// [angle]. Not thread-safe, see SensorData.
class ORTUNG_API PoseData : public SensorData {
 public:
  using Reading = Pose2;
  explicit PoseData(SensorId id);
  ~PoseData() override;
  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Pose2& pose);
  static void encode(const Pose2& pose, std::vector<std::uint32_t>& words);
  /// Makes a feature of this class with the words and parameters of another one that has this
  /// format, whatever its class; null if its format is another one (readingAs()).
  static std::unique_ptr<PoseData> like(const SensorData& feature);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Pose2 reading_;
};

}  // namespace ortung

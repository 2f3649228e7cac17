#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// The samples of a localization, for display: the feature mcl/LOCALIZATION/samples
/// (LocalizationConfig::publish), which is set only while a client wants it.
/// Four words a sample: x, y [mm + 2^31], heading [1/100 degree, 0 to 35999], weight relative to
/// the heaviest [1/65535]. Of more than kMostSamples only every n-th is sent. It only
/// reports, so it weighs no samples. Not thread-safe, see SensorData.
class ORTUNG_API SamplesData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kSamples;
  struct Sample {
    Pose2 pose;           ///< pose in the field frame
    double weight = 0.0;  ///< weight relative to the heaviest sample's, in [0, 1]
  };
  using Reading = std::vector<Sample>;
  static constexpr std::size_t kMostSamples = 10'000;

  SamplesData();
  ~SamplesData() override;
  /// Decodes the words on each call, since the localization's own program never needs it.
  Reading reading() const;
  /// Returns the words of the first kMostSamples samples.
  static std::vector<std::uint32_t> encode(std::span<const Sample> samples);
  static Message message(Timestamp stamp, std::span<const Sample> samples);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t>) override {}
};

}  // namespace ortung

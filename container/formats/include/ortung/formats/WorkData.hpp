#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// The work load of a localization: the feature mcl/LOCALIZATION/work
/// (LocalizationConfig::publish). Words: samples, effective samples, duration of the newest update
/// [us], estimates so far. It only reports, so it weighs no samples. Not thread-safe, see
/// SensorData.
class ORTUNG_API WorkData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kWork;
  struct Reading {
    std::size_t samples = 0;  ///< size of the sample set
    /// Samples that are worth as much: 1 / sum w^2 of the weights, rounded.
    double effectiveSamples = 0.0;
    double seconds = 0.0;         ///< computing time of the newest update [s]
    std::uint64_t estimates = 0;  ///< number of estimates so far; begins anew after 2^32
  };

  WorkData();
  ~WorkData() override;
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

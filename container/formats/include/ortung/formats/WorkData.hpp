#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// What a localization has to do: the feature mcl/LOCALIZATION/work (LocalizationConfig::publish).
/// Words: samples, what these are worth as equal samples, duration of the newest update [us],
/// estimates so far. It says nothing about the pose, so it weighs no samples. Not thread-safe, see
/// SensorData.
class ORTUNG_API WorkData : public SensorData {
 public:
  struct Reading {
    std::size_t samples = 0;
    double effectiveSamples = 0.0;  ///< 1 / sum w^2 of their weights, rounded
    double seconds = 0.0;           ///< that the newest update took
    std::uint64_t estimates = 0;    ///< so far; begins anew after 2^32
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

#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// The protection level of a localization's estimate, for other programs: the feature
/// mcl/LOCALIZATION/protection beside mcl/LOCALIZATION/pose (LocalizationConfig::publish).
/// Words: radius [1e-6 m] and angle [1/10000 degree], rounded up, since they are bounds;
/// 4294967295 for what nothing bounds. It only reports, so it weighs no samples.
/// Not thread-safe, see SensorData.
class ORTUNG_API ProtectionData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kProtection;
  /// Infinite where other places may be right, too.
  struct Reading {
    double metres = std::numeric_limits<double>::infinity();   ///< of the position
    double radians = std::numeric_limits<double>::infinity();  ///< of the heading
  };

  ProtectionData();
  ~ProtectionData() override;
  const Reading& reading() const { return reading_; }
  /// NaN is taken as infinite.
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

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// Where a localization has found that the map no longer fits: the feature mcl/LOCALIZATION/map
/// (LocalizationConfig::publish), set when that changes, once a second at most, and repeated every
/// two seconds. Words: edge of a cell [mm], then six a cell: 0 for a wall that is gone or 1 for
/// something new, whether it is sure (0 or 1), x and y of what was found in it [mm + 2^31, field
/// frame], passes of the robot in which it was found so, and in which it was not. Of more than
/// kMostCells those that are not sure are left out first. It only reports, so it weighs no samples.
/// Not thread-safe, see SensorData.
class ORTUNG_API ChangesData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kChanges;
  static constexpr std::size_t kMostCells = 5'000;
  struct Cell {
    bool isNew = false;  ///< something new, else a wall that is gone
    bool isSure = false;
    double x = 0.0;  ///< middle of what was found in it, field frame [m]
    double y = 0.0;
    std::uint32_t passes = 0;   ///< passes in which it was found so
    std::uint32_t against = 0;  ///< passes in which it was not
    bool operator==(const Cell&) const = default;
  };
  struct Reading {
    double cell = 0.1;  ///< edge of a cell [m]
    std::vector<Cell> cells;
  };

  ChangesData();
  ~ChangesData() override;
  /// Decodes the words on each call, since the localization's own program never needs it.
  Reading reading() const;
  static std::vector<std::uint32_t> encode(const Reading& reading);
  static Message message(Timestamp stamp, const Reading& reading);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t>) override {}
};

}  // namespace ortung

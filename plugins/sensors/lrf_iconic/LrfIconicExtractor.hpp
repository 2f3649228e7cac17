#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "LrfIconicSettings.hpp"
#include "ScanShapes.hpp"
#include "ortung/core/Extractor.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

class WallMatcher;

/// Segments a scan, and matches its straight pieces with the field's walls and goals; it treats
/// simulated, recorded and real scans alike. Features: obstacles, position.
class LrfIconicExtractor : public Extractor {
 public:
  explicit LrfIconicExtractor(const Parameters& p);
  ~LrfIconicExtractor() override;

  std::vector<std::string> inputs() const override;
  void take(std::span<const SensorData* const> inputs) override;
  void extract(const FieldModel& field, std::span<std::optional<Words>> words) override;

 private:
  const WallMatcher& matcherOf(const FieldModel& field);
  std::vector<std::uint8_t> beamsOnCircles(const ScanShapes& shapes) const;
  ObstaclesData::Reading obstacles(const ScanShapes& shapes, const WallMatcher& matcher,
                                   const std::vector<PoseFixData::Fix>& fixes) const;

  LrfIconicSettings settings_;
  ScanData::Reading scan_;
  Pose2 mount_;                   ///< pose of the scanner in the robot frame
  double maxRange_ = 0.0;         ///< greatest range of the scan [m]
  std::vector<FieldWall> walls_;  ///< walls and noise of the matcher
  double sigma_ = 0.0;            ///< [m]
  std::unique_ptr<WallMatcher> matcher_;
};

}  // namespace ortung

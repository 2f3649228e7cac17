#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "TeammateSettings.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Extractor.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/TalkData.hpp"

namespace ortung {

/// Makes readings of what a team tells (paper, section 6): where they see this robot is a position,
/// and of other robots and of balls it knows the places.
class TeammateExtractor : public Extractor {
 public:
  explicit TeammateExtractor(const Parameters& p) : settings_(readTeammateSettings(p)) {}

  std::vector<std::string> inputs() const override;
  void take(std::span<const SensorData* const> inputs) override;
  void extract(const FieldModel& field, std::span<std::optional<Words>> words) override;

 private:
  struct Known {
    PlacesData::Told told;
    Timestamp said = 0;
  };
  /// By what is there and, for balls, who says so.
  using Memory = std::map<std::pair<std::string, std::string>, Known>;

  void remember(Memory& memory, Known known, const std::string& source);
  PlacesData::Reading recall(Memory& memory) const;

  TeammateSettings settings_;
  TalkData::Reading talk_;
  Timestamp now_ = 0;
  Memory robots_;
  Memory balls_;
};

}  // namespace ortung

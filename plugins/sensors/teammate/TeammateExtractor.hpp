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

/// Makes readings of the team's messages (paper, section 6): the positions at which mates see this
/// robot, and the places of other robots and of balls.
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
  /// Reports by object and, for balls, by sender.
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

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {

/// A served world without what not every world has: no players, no time of its own nor a time line,
/// nothing on its field, no robots but those of clients, no talk. What there is overrides that.
class ORTUNG_API PlainWorld : public ServedWorld {
 public:
  ~PlainWorld() override;

  /// Nothing is on its field, and there are no players.
  std::vector<std::string> players() const override { return {}; }
  std::vector<std::string> robotKinds() const override { return {}; }
  std::vector<std::string> field() const override { return {}; }
  std::vector<ServedFeature> truthFeatures() const override { return {}; }
  std::span<Message> truth() override { return {}; }

  /// Its time is the board's, begins at once and never ends; there is no time line and no seed.
  Timestamp livePeriod() const override { return 0; }
  bool isReady() const override { return true; }
  bool isAtEnd() const override { return false; }
  /// @throws ServeError always
  void seek(Timestamp stamp) override;
  std::optional<std::uint64_t> seed() const override { return std::nullopt; }

  /// It has no robots of its own and no talk, and senses all features whatever clients ask for.
  std::vector<Resident> residents() const override { return {}; }
  std::uint64_t residentsVersion() const override { return 0; }
  std::string side(RobotId /*robot*/) const override { return {}; }
  void want(RobotId, std::span<const SensorId> /*features*/) override {}
  std::vector<Message> lateReadings(RobotId) override { return {}; }
  void tell(RobotId, std::string_view /*text*/) override {}
  std::vector<ServedTalk> takeHeard(RobotId) override { return {}; }
};

}  // namespace ortung

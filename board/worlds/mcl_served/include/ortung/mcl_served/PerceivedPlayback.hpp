#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/mcl_served/FilterThread.hpp"
#include "ortung/mcl_served/PerceivingRobots.hpp"
#include "ortung/server/ForwardedWorld.hpp"

namespace ortung {

/// Records with a time line whose readings can be weighed: what a robot perceives is the newest
/// reading of each of its features at the moment that is being looked at, none older than three
/// seconds. So it depends on that moment alone, whether it was played to or jumped to.
/// Not thread-safe, but for PerceivingRobots.
class ORTUNG_API PerceivedPlayback final : public ForwardedWorld, public PerceivingRobots {
 public:
  struct Config {
    std::filesystem::path robot;  ///< robot file of all runs
    TableGiver tables;            ///< called once, when tables are first needed
  };

  /// @param playback borrowed; the readings() of its robots stay until its next step
  /// @throws ConfigError, PluginError of the robot file
  PerceivedPlayback(ServedWorld& playback, Config config);
  ~PerceivedPlayback() override;
  PerceivedPlayback(const PerceivedPlayback&) = delete;
  PerceivedPlayback& operator=(const PerceivedPlayback&) = delete;

  /// Has the tables now, which learning may delay; else perceiver() learns them in the background.
  /// @param goOn called with the share that is done; false gives up
  /// @returns whether it has them @throws what TableGiver does
  bool fetchTables(const std::function<bool(double)>& goOn);

  // PerceivingRobots
  std::optional<RobotId> usual() const override;
  bool isForAll() const override { return true; }
  /// @throws ServeError also while tables are being learned (`state`), with the share that is done
  std::shared_ptr<const Robot> perceiver(RobotId robot) const override;

  // ServedWorld
  void step() override;
  void seek(Timestamp stamp) override;
  void reset(std::optional<std::uint64_t> seed) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung

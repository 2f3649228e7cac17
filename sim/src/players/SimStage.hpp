#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/sim/FloorPlans.hpp"
#include "ortung/sim/Simulation.hpp"
#include "ortung/sim_api/Stage.hpp"

namespace ortung {

/// A simulation as its players and its referee see and change it.
class SimStage : public Stage {
 public:
  /// @param simulation, plans borrowed
  SimStage(Simulation& simulation, FloorPlans& plans,
           std::function<std::string(std::string_view)> teamOf)
      : simulation_(simulation), plans_(plans), teamOf_(std::move(teamOf)) {}

  Timestamp now() const override { return simulation_.now(); }
  double cycle() const override { return simulation_.cycle(); }
  const World& world() const override { return simulation_.world(); }
  std::span<const StagedRobot> robots() const override;
  std::span<const StagedThing> things() const override;
  void placeRobot(std::string_view robot, const Pose2& pose) override;
  void placeThing(std::string_view thing, const Pose2& pose, const Twist& velocity) override;
  std::shared_ptr<const FloorPlan> floorPlan(const RobotSize& size) override {
    return plans_.of(size);
  }

  Simulation& simulation() { return simulation_; }

  /// Drops the cached states after robots were added, removed or moved within a cycle.
  void forget() { seen_.reset(); }

 private:
  void look() const;
  Simulation& simulation_;
  FloorPlans& plans_;
  std::function<std::string(std::string_view)> teamOf_;
  /// Time of the cached states. Bodies do not move while players act, except those that they place.
  mutable std::optional<Timestamp> seen_;
  mutable std::vector<StagedRobot> robots_;
  mutable std::vector<StagedThing> things_;
};

}  // namespace ortung

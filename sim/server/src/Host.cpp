#include "Host.hpp"

namespace ortung::server {
namespace {

RobotId liveRobotOf(const ServedWorld& world) {
  if (world.livePeriod() == 0) return 0;
  const std::vector<Resident> residents = world.residents();
  return residents.empty() ? 0 : residents.front().robot;
}

}  // namespace

Outlet::~Outlet() = default;

Host::Host(ServedWorld& world, const BoardConfig& boardConfig, WorldKeeper& worldKeeper)
    : config(boardConfig),
      description(world.describe()),
      plugins(world.plugins()),
      liveRobot(liveRobotOf(world)),
      keeper(worldKeeper),
      door(config) {}
Host::~Host() = default;

}  // namespace ortung::server

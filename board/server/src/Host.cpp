#include "Host.hpp"

namespace ortung::server {
namespace {

constexpr double kClientsAtOnce = 20.0;  // clients that may talk at once as much as one may

RobotId liveRobotOf(const ServedWorld& world) {
  if (world.livePeriod() == 0) return 0;
  const std::vector<Resident> residents = world.residents();
  return residents.empty() ? 0 : residents.front().robot;
}

}  // namespace

Outlet::~Outlet() = default;

void Outlet::add(Output&& output) {
  std::vector<std::string_view> pieces;
  output.look(output.size(), pieces);
  for (const std::string_view piece : pieces) append(piece);
}

Host::Host(ServedWorld& world, const BoardConfig& boardConfig, WorldKeeper& worldKeeper)
    : config(boardConfig),
      commands(boardConfig.commands),
      description(world.describe()),
      plugins(world.plugins()),
      players(world.players()),
      robotKinds(world.robotKinds()),
      liveRobot(liveRobotOf(world)),
      keeper(worldKeeper),
      door(config),
      talk(kClientsAtOnce * config.limits.talkLines, kClientsAtOnce * config.limits.talkBytes) {}
Host::~Host() = default;

void Host::workLong(ClientId /*client*/, SlowTask task) {
  work([task = std::move(task)] { task.run(); });
}

}  // namespace ortung::server

#include "ortung/mcl_served/WorldTables.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "ortung/sim/TableStore.hpp"

namespace ortung {

TableGiver learnedTables(const std::filesystem::path& world) {
  constexpr double kCell = 0.1;  // [m]; in a quarter of the time that a player's tables take
  return [store = std::make_shared<TableStore>(world, kCell)](
             const Robot& robot, const std::function<bool(double)>& goOn) {
    PluginFactory factory(PluginFactory::standardFolders());
    return store->of(robot.config, robot.container, factory, goOn);
  };
}

TableGiver givenTables(const std::filesystem::path& file, const std::string& worldFingerprint) {
  auto tables = std::make_shared<const RobotTables>(file);
  const TableInfo& info = tables->info();
  if (!worldFingerprint.empty() && !info.worldFingerprint.empty() &&
      info.worldFingerprint != worldFingerprint)
    throw std::invalid_argument(file.string() + " was learned in the world " +
                                info.worldFingerprint + " ('" + info.world + "'), this one is " +
                                worldFingerprint);
  return [tables](const Robot&, const std::function<bool(double)>&) { return tables; };
}

}  // namespace ortung

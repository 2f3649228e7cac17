#include "Play.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "Console.hpp"
#include "HostPort.hpp"
#include "Interrupt.hpp"
#include "TokenFile.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/remote/RemotePlay.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/PlayerWish.hpp"

namespace ortung::app {
namespace {

void readServer(const std::string& text, SessionOptions& options) {
  const auto found = parseHostPort(text);
  // Without a host, or with port 0, no server can be reached.
  if (!found || text.starts_with(':') || found->port.value_or(0) == 0)
    throw UsageError(
        fmt::format("--server is '{}', expected HOST:PORT, e.g. 127.0.0.1:7777", text));
  options.host = found->host;
  options.port = *found->port;
}

/// Returns the token of the robot's name, else that of "*".
std::string tokenFor(const std::string& name, const std::filesystem::path& file) {
  if (file.empty()) {
    const char* token = std::getenv("ORTUNG_TOKEN");
    return token == nullptr ? "" : token;
  }
  const std::vector<BoardToken> tokens = readTokens(file);
  for (const std::string& wanted : {name, std::string("*")})
    for (const BoardToken& one : tokens)
      if (one.name == wanted) return one.token;
  throw std::runtime_error(file.string() + ": has no token for '" + name + "'");
}

}  // namespace

int runPlay(const PlayArguments& arguments) {
  const PlayerWish wish = parsePlayer(arguments.player);
  RemotePlayConfig config;
  readServer(arguments.server, config.session);
  PluginFactory factory(PluginFactory::standardFolders());
  std::unique_ptr<Player> player = factory.make<Player>(wish.plugin, wish.options);
  config.robot = wish.robot.empty() ? player->robotFile() : wish.robot;
  config.session.name = wish.name;
  if (wish.name.empty() && !config.robot.empty())
    config.session.name = readRobot(shippedFile("robots", config.robot)).name;
  config.session.token = tokenFor(config.session.name, arguments.tokens);
  config.session.start = wish.start;
  config.session.isInterruptible = true;
  config.session.isBinary = true;
  config.plugin = wish.plugin;
  config.team = wish.team;
  config.tables = arguments.tables;
  config.seed = arguments.seed;
  config.isLockstep = arguments.lockstep;
  config.budget = arguments.budgetMs / 1000.0;
  config.duration = arguments.duration;
  config.goesOn = [] { return interruptSignal() == 0; };
  try {
    RemotePlay play(std::move(player), config);
    play.run();
    fmt::print("{}: {} played until {:.2f} s\n", config.session.server(), config.session.name,
               toSeconds(play.now()));
  } catch (const ConnectionLost&) {
    if (interruptSignal() == 0) throw;  // else it is the signal that has ended the connection
  }
  return 0;
}

}  // namespace ortung::app

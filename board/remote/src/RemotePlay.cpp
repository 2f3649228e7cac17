#include "ortung/remote/RemotePlay.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "RemoteSeat.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/RobotTables.hpp"
#include "ortung/sim_api/PlayerGuard.hpp"

namespace ortung {
namespace {

constexpr std::uint64_t kStream = 1;            // of the player's random numbers
constexpr std::chrono::milliseconds kPause{5};  // before it is asked again what is new
constexpr std::chrono::seconds kPatience{60};   // without a reading

std::filesystem::path robotFileOf(const PlayerNeeds& needs, const RemotePlayConfig& config) {
  if (needs.stage)
    throw std::invalid_argument("the player '" + config.plugin +
                                "' needs the world's state, which clients of a server do not see; "
                                "it plays in the simulator only (ortung sim --player)");
  if (needs.tables && config.tables.empty())
    throw std::invalid_argument("the player '" + config.plugin +
                                "' needs tables of its robot for the server's world "
                                "(--tables FILE)");
  const std::filesystem::path file = config.robot.empty() ? needs.robotFile : config.robot;
  if (file.empty())
    throw std::invalid_argument("the player '" + config.plugin +
                                "' names no robot file, so one must be given (robot=FILE)");
  return shippedFile("robots", file);
}

RemoteOptions optionsOf(const RemotePlayConfig& config) {
  RemoteOptions options;
  options.session = config.session;
  options.session.team = config.team;
  options.cycle = 0.0;  // the player's rhythm is that of the readings
  options.reconnects = false;
  options.hasLocalStamps = false;
  return options;
}

}  // namespace

PlayerStopped::~PlayerStopped() = default;

struct RemotePlay::Parts {
  using Clock = std::chrono::steady_clock;

  RemotePlayConfig config;
  std::unique_ptr<Player> player;
  PlayerNeeds needs;
  RemoteRobot robot;
  PlayerGuard guard;
  Taught taught;
  FieldModel field;
  remote::RemoteSeat seat;
  Timestamp period;

  Parts(std::unique_ptr<Player> given, const RemotePlayConfig& c)
      : config(c),
        player(std::move(given)),
        needs(needsOf(*player, config.plugin)),
        robot(robotFileOf(needs, config), optionsOf(config)),
        guard(config.plugin, config.session.name, config.budget),
        field(teach()),
        seat(robot, config.session.name, config.team, field, taught, Random(config.seed, kStream)),
        period(fromSeconds(needs.period)) {}

  /// @returns what is known of the field
  FieldModel teach() {
    const RobotConfig file = readRobot(robotFileOf(needs, config));
    taught.mcl = file.mcl;
    taught.motion = file.motion;
    if (config.tables.empty()) return {};
    const RobotTables tables(config.tables);
    tables.giveTo(robot.container());
    taught.region = tables.region();
    return tables.info().field;
  }

  template <class Call>
  void call(const char* what, const Call& action) {
    const std::string why = guard(what, action);
    if (why.empty()) return;
    if (!goesOn()) return;   // who ended it has ended the connection, too
    seat.voice().rethrow();  // the connection's fault
    throw PlayerStopped("at " + std::to_string(toSeconds(seat.now())) + " s: " + why +
                        "; it is stopped, and its robot leaves the field");
  }

  /// Something went wrong with the server, or its world has come to an end.
  void checkTrouble() const {
    const std::string trouble = robot.trouble();
    if (trouble.empty() || !goesOn()) return;
    throw robot.isConnected() ? std::runtime_error(trouble) : ConnectionLost(trouble);
  }

  /// Waits for new readings. @returns whether there are some
  bool advance() {
    if (config.isLockstep) {
      if (robot.next()) return true;
      checkTrouble();
      return false;
    }
    const auto begin = Clock::now();
    const Timestamp before = seat.now();
    while (goesOn()) {
      if (!robot.update()) checkTrouble();
      if (robot.newest() != before) return true;
      if (Clock::now() - begin > kPatience)
        throw ConnectionLost(config.session.server() + ": gave no reading for " +
                             std::to_string(kPatience.count()) + " s");
      std::this_thread::sleep_for(kPause);
    }
    return false;
  }

  bool goesOn() const { return !config.goesOn || config.goesOn(); }

  void play() {
    const Timestamp begin = seat.now();
    Timestamp due = begin;
    bool isOver = false;
    while (!isOver && goesOn() && advance()) {
      const Timestamp last = seat.now();
      seat.look();
      const Timestamp now = seat.now();
      if (config.duration && now - begin > fromSeconds(*config.duration)) return;
      if (now < last) due = now;  // the world has started over
      if (now < due) continue;
      due = std::max(due + period, now + 1);
      seat.listen();
      seat.watchGame();
      call("senseAndAct", [&] { isOver = !player->senseAndAct(seat); });
      seat.forgetHeard();
    }
  }
};

RemotePlay::RemotePlay(std::unique_ptr<Player> player, const RemotePlayConfig& config)
    : parts_(std::make_unique<Parts>(std::move(player), config)) {}

RemotePlay::~RemotePlay() = default;

void RemotePlay::run() {
  Parts& parts = *parts_;
  parts.seat.watchGame();
  parts.call("begin", [&] { parts.player->begin(parts.seat); });
  parts.play();
  parts.call("end", [&] { parts.player->end(parts.seat); });
}

Timestamp RemotePlay::now() const { return parts_->seat.now(); }

}  // namespace ortung

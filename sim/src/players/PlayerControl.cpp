#include "ortung/sim/PlayerControl.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <iterator>
#include <map>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>

#include "SimSeat.hpp"
#include "SimStage.hpp"
#include "ortung/sim_api/PlayerGuard.hpp"

namespace ortung {
namespace {

constexpr std::ptrdiff_t kMostSaid = 64;  // greatest number of messages of one robot in a cycle

std::shared_ptr<const FieldRegion> give(const RobotTables& tables, SimRobot& robot) {
  tables.giveTo(robot.container());
  return tables.region();
}

}  // namespace

struct PlayerControl::Parts {
  /// A player on its seat.
  struct Seating {
    std::string plugin;
    std::unique_ptr<Player> player;
    std::unique_ptr<PlayerGuard> guard;
    std::unique_ptr<SimSeat> seat;
    Timestamp since = 0;
    Timestamp period = 0;
    Timestamp due = 0;
    std::uint64_t orders = 0;  ///< commands from outside that the robot had when the player began
    RobotNumber number = 0;    ///< the robot's number, which is never reused
    bool isGuest = false;
    bool isOver = false;
    PlayerWish wish;  ///< how it was made, to make it again
  };

  Simulation& simulation;
  FloorPlans& plans;
  PluginFactory& factory;
  Config config;
  SimStage stage;
  std::shared_ptr<const FieldModel> field;
  std::vector<std::unique_ptr<Seating>> seatings;
  std::map<std::string, std::string, std::less<>> teams;  ///< teams by robot
  /// Messages for robots without a player.
  std::map<std::string, std::vector<Heard>, std::less<>> ears;
  std::vector<Heard> said;                       ///< messages sent in this cycle
  std::atomic<const Seating*> called = nullptr;  ///< whose function is under way; null: nobody's
  std::atomic<bool> isAbandoned = false;         ///< see abandon()
  /// Players of robots that were commanded from outside; who plays them now is nobody.
  std::map<RobotNumber, PlayerWish> taken;
  std::atomic<bool> isStill = false;  ///< the simulation's thread waits for the end

  Parts(Simulation& s, FloorPlans& p, PluginFactory& f, const Config& c)
      : simulation(s),
        plans(p),
        factory(f),
        config(c),
        stage(s, p, [this](std::string_view robot) { return teamOf(robot); }),
        field(s.world().field()) {}

  std::string teamOf(std::string_view robot) const {
    const auto found = teams.find(robot);
    return found == teams.end() ? "" : found->second;
  }
  bool isThere(const Seating& one) const { return simulation.find(one.number) != nullptr; }
  void sit(SimRobot& robot, std::unique_ptr<Player> player, const PlayerWish& wish,
           const Random& random, bool isGuest);
  std::shared_ptr<const FieldRegion> teach(SimRobot& robot, const PlayerWish& wish, bool needs);
  void say(std::string_view robot, std::string_view text);
  void deliver();
  void tell(SimRobot& robot, const std::vector<Heard>& messages) const;
  template <class Call>
  void call(Seating& one, const char* what, const Call& call);
  void report(const std::string& why, const char* what) const;
  void act(Seating& one, const Game& game);
  bool farewell(Seating& one);
  void finish(Seating& one);
  void endAll();
  void drop();
  bool abandon(std::chrono::duration<double> patience);
  /// To be called before anything is changed. After abandon() it does not return.
  void keepStill() {
    if (!isAbandoned) return;
    isStill = true;
    while (true) std::this_thread::sleep_for(std::chrono::hours(1));
  }
};

void PlayerControl::Parts::sit(SimRobot& robot, std::unique_ptr<Player> player,
                               const PlayerWish& wish, const Random& random, bool isGuest) {
  keepStill();
  const std::string& name = robot.config().name;
  for (const auto& one : seatings)
    if (!one->isOver && one->number == robot.state().number)
      throw std::invalid_argument("robot " + name + ": the player '" + one->plugin +
                                  "' plays it already, so '" + wish.plugin + "' can't");
  const PlayerNeeds needs = needsOf(*player, wish.plugin);
  if (needs.stage && !wish.seesStage)
    throw std::invalid_argument("robot " + name + ": the player '" + wish.plugin +
                                "' needs the world's state, which it is not to see");
  std::shared_ptr<const FieldRegion> region = teach(robot, wish, needs.tables);
  if (needs.pictures) robot.setWanted({}, true);
  auto seating = std::make_unique<Seating>();
  seating->plugin = wish.plugin;
  seating->guard = std::make_unique<PlayerGuard>(wish.plugin, name, config.budget);
  seating->seat = std::make_unique<SimSeat>(
      robot, wish.team, *field, wish.seesStage ? &stage : nullptr, std::move(region), random,
      [this, name](std::string_view text) { say(name, text); });
  seating->player = std::move(player);
  seating->since = simulation.now();
  seating->period = fromSeconds(needs.period);
  seating->due = simulation.now();
  seating->orders = robot.orders();
  seating->number = robot.state().number;
  seating->isGuest = isGuest;
  seating->wish = wish;
  taken.erase(seating->number);
  seating->seat->setTime(simulation.now());
  if (!wish.team.empty()) {
    teams[name] = wish.team;
    simulation.setTeam(robot, wish.team);
  }
  Seating& one = *seating;
  seatings.push_back(std::move(seating));
  call(one, "begin", [&] { one.player->begin(*one.seat); });
}

/// Gives a robot its tables. @returns the region in which it can stand; null if its player does not
/// need tables
std::shared_ptr<const FieldRegion> PlayerControl::Parts::teach(SimRobot& robot,
                                                               const PlayerWish& wish, bool needs) {
  const std::string who = "robot " + robot.config().name + ": the player '" + wish.plugin + "'";
  if (wish.tables.empty() && !needs) return nullptr;
  if (wish.tables.empty() && !config.tables)
    throw std::invalid_argument(who + " needs tables of its robot for this world (tables=FILE)");
  if (wish.tables.empty()) return give(*config.tables->of(robot, factory), robot);
  const RobotTables tables(wish.tables);
  const std::string world = simulation.world().fingerprint();
  if (tables.info().worldFingerprint != world)
    throw std::invalid_argument(who + ": " + wish.tables.string() + " was learned in the world " +
                                tables.info().worldFingerprint + " ('" + tables.info().world +
                                "'), but it plays in " + world);
  return give(tables, robot);
}

/// Calls a player; a failure ends this player alone.
template <class Call>
void PlayerControl::Parts::call(Seating& one, const char* what, const Call& call) {
  called = &one;
  if (isAbandoned) called = nullptr;  // nobody is: abandon() asks after it has forbidden calls
  keepStill();
  const std::string why = (*one.guard)(what, call);
  called = nullptr;
  keepStill();
  if (why.empty()) return;
  one.isOver = true;
  report(why, one.isGuest ? "; it is stopped" : "; it is stopped, and its robot leaves the field");
}

void PlayerControl::Parts::report(const std::string& why, const char* what) const {
  if (config.onProblem)
    config.onProblem("at " + std::to_string(toSeconds(simulation.now())) + " s: " + why + what);
}

void PlayerControl::Parts::say(std::string_view robot, std::string_view text) {
  checkSaid(text);
  if (std::count_if(said.begin(), said.end(),
                    [&](const Heard& one) { return one.from == robot; }) >= kMostSaid)
    throw std::invalid_argument("sends more than " + std::to_string(kMostSaid) +
                                " messages in a cycle");
  said.push_back({std::string(robot), simulation.now(), std::string(text)});
}

void PlayerControl::Parts::deliver() {
  if (said.empty()) return;
  std::vector<Heard> messages = std::exchange(said, {});
  // The order in which messages arrive over a network is random.
  std::stable_sort(messages.begin(), messages.end(), [](const Heard& a, const Heard& b) {
    return std::tie(a.stamp, a.from) < std::tie(b.stamp, b.from);
  });
  for (const Heard& message : messages) {
    const std::string team = teamOf(message.from);
    for (const auto& one : seatings)
      if (one->seat->name() != message.from && one->seat->team() == team) one->seat->hear(message);
    for (auto& [name, heard] : ears) {
      if (name != message.from && teamOf(name) == team) keepHeard(heard, message);
    }
  }
  for (const auto& robot : simulation.robots())
    if (robot->hasEars()) tell(*robot, messages);
}

/// Delivers messages to a robot's features, whether or not it has a player.
void PlayerControl::Parts::tell(SimRobot& robot, const std::vector<Heard>& messages) const {
  const std::string& name = robot.config().name;
  const std::string team = teamOf(name);
  std::vector<Heard> told;
  std::copy_if(messages.begin(), messages.end(), std::back_inserter(told),
               [&](const Heard& one) { return one.from != name && teamOf(one.from) == team; });
  robot.hear(simulation.now(), told);
}

void PlayerControl::Parts::act(Seating& one, const Game& game) {
  const Timestamp now = simulation.now();
  if (one.isOver || now < one.due) return;
  // Keeps the rhythm when a period is no multiple of the cycle.
  one.due = std::max(one.due + one.period, now + 1);
  one.seat->setTime(now);
  one.seat->setGame(game);
  call(one, "senseAndAct", [&] {
    if (!one.player->senseAndAct(*one.seat)) one.isOver = true;
  });
  one.seat->forgetHeard();
}

/// Ends a player; its robot stays. @returns whether the robot is there
bool PlayerControl::Parts::farewell(Seating& one) {
  const bool wasThere = isThere(one);
  if (wasThere) call(one, "end", [&] { one.player->end(*one.seat); });
  one.player.reset();
  return wasThere;
}

void PlayerControl::Parts::finish(Seating& one) {
  if (!farewell(one) || one.isGuest) return;
  teams.erase(one.seat->name());
  simulation.removeRobot(one.seat->simRobot());
}

void PlayerControl::Parts::endAll() {
  keepStill();
  while (!seatings.empty()) {  // each leaves the list whatever becomes of its call
    const std::unique_ptr<Seating> one = std::move(seatings.front());
    seatings.erase(seatings.begin());
    farewell(*one);
  }
}

/// The simulation's thread, if it comes back from whatever it is in, waits in keepStill(), so that
/// nothing changes while players say goodbye.
bool PlayerControl::Parts::abandon(std::chrono::duration<double> patience) {
  using Clock = std::chrono::steady_clock;
  isAbandoned = true;
  // It may be in no player at all.
  const auto latest = Clock::now() + patience / 2;
  while (!isStill && called == nullptr && Clock::now() < latest)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const Seating* const lost = isStill ? nullptr : called.load();
  const auto done = std::make_shared<std::promise<void>>();
  std::future<void> all = done->get_future();
  const auto end = [this, lost, done] {
    for (const auto& one : seatings) {
      if (one.get() == lost || !one->player || !isThere(*one)) continue;
      const std::string why = (*one->guard)("end", [&] { one->player->end(*one->seat); });
      if (!why.empty()) report(why, "");
    }
    done->set_value();
  };
  try {
    std::thread(end).detach();  // one of them may not come back either
  } catch (const std::system_error&) {
    return false;
  }
  return all.wait_for(patience) == std::future_status::ready;
}

/// Ends players whose robots are gone, or are commanded from outside.
void PlayerControl::Parts::drop() {
  for (const auto& one : seatings) {
    if (one->isOver) continue;
    const bool isTaken =
        isThere(*one) && one->isGuest && one->seat->simRobot().orders() != one->orders;
    one->isOver = isTaken || !isThere(*one);
    if (isTaken) taken.insert_or_assign(one->number, one->wish);
  }
}

PlayerControl::PlayerControl(Simulation& simulation, FloorPlans& plans, PluginFactory& factory,
                             const Config& config)
    : parts_(std::make_unique<Parts>(simulation, plans, factory, config)) {
  if (!(config.budget >= 0.0))
    throw std::invalid_argument("PlayerControl::Config::budget is " +
                                std::to_string(config.budget) + ", must be at least 0 s");
}

PlayerControl::~PlayerControl() {
  while (!parts_->seatings.empty()) {
    try {
      parts_->endAll();
    } catch (const std::exception&) {  // of onProblem; callers that need the error call endAll()
      continue;                        // the others are ended, too
    }
  }
}

std::unique_ptr<Player> PlayerControl::make(const PlayerWish& wish) {
  return parts_->factory.make<Player>(wish.plugin, wish.options);
}

void PlayerControl::lead(SimRobot& robot, const PlayerWish& wish, const Random& random) {
  parts_->sit(robot, make(wish), wish, random, true);
}

std::string PlayerControl::takenFrom(const SimRobot& robot) const {
  const auto found = parts_->taken.find(robot.state().number);
  return found == parts_->taken.end() ? "" : found->second.plugin;
}

bool PlayerControl::giveBack(SimRobot& robot, const Random& random) {
  const auto found = parts_->taken.find(robot.state().number);
  if (found == parts_->taken.end()) return false;
  const PlayerWish wish = found->second;
  lead(robot, wish, random);
  return true;
}

void PlayerControl::own(SimRobot& robot, std::unique_ptr<Player> player, const PlayerWish& wish,
                        const Random& random) {
  parts_->sit(robot, std::move(player), wish, random, false);
}

bool PlayerControl::stop(std::string_view robot) {
  for (const auto& one : parts_->seatings) {
    if (one->isOver || one->seat->name() != robot) continue;
    one->isOver = true;
    return true;
  }
  return false;
}

void PlayerControl::endAll() { parts_->endAll(); }

bool PlayerControl::abandon(std::chrono::duration<double> patience) {
  return parts_->abandon(patience);
}

void PlayerControl::deliver() {
  parts_->keepStill();
  parts_->deliver();
}

void PlayerControl::act(const Game& game) {
  parts_->keepStill();
  parts_->stage.forget();
  parts_->drop();
  parts_->deliver();  // if the caller has not done so
  for (std::size_t i = 0; i < parts_->seatings.size(); ++i) parts_->act(*parts_->seatings[i], game);
}

void PlayerControl::clear() {
  parts_->keepStill();
  parts_->drop();
  std::erase_if(parts_->seatings, [&](const std::unique_ptr<Parts::Seating>& one) {
    if (one->isOver) parts_->finish(*one);
    return one->isOver;
  });
}

Stage& PlayerControl::stage() {
  parts_->stage.forget();
  return parts_->stage;
}

void PlayerControl::setTeam(std::string_view robot, std::string_view team) {
  parts_->teams[std::string(robot)] = team;
  for (const auto& one : parts_->simulation.robots())
    if (one->config().name == robot) parts_->simulation.setTeam(*one, std::string(team));
}

std::string PlayerControl::teamOf(std::string_view robot) const { return parts_->teamOf(robot); }

void PlayerControl::join(std::string_view robot, std::string_view team) {
  setTeam(robot, team);
  parts_->ears[std::string(robot)].clear();
}

void PlayerControl::leave(std::string_view robot) {
  const auto teamed = parts_->teams.find(robot);
  if (teamed != parts_->teams.end()) parts_->teams.erase(teamed);
  const auto listening = parts_->ears.find(robot);
  if (listening != parts_->ears.end()) parts_->ears.erase(listening);
}

std::vector<Heard> PlayerControl::takeHeard(std::string_view robot) {
  const auto found = parts_->ears.find(robot);
  return found == parts_->ears.end() ? std::vector<Heard>{} : std::exchange(found->second, {});
}

void PlayerControl::say(std::string_view robot, std::string_view text) { parts_->say(robot, text); }

std::vector<PlayerControl::Seated> PlayerControl::players() const {
  std::vector<Seated> players;
  for (const auto& one : parts_->seatings)
    if (!one->isOver)
      players.push_back(
          {one->seat->name(), one->plugin, one->seat->team(), one->since, one->isGuest});
  return players;
}

std::optional<BelievedPose> PlayerControl::believedPose(const SimRobot& robot) {
  std::optional<BelievedPose> pose;
  for (const auto& one : parts_->seatings)
    if (!one->isOver && one->number == robot.state().number)
      parts_->call(*one, "believedPose", [&] { pose = one->player->believedPose(); });
  return pose;
}

bool PlayerControl::isEmpty() const { return parts_->seatings.empty(); }

Simulation* simulationOf(Stage& stage) {
  auto* simulated = dynamic_cast<SimStage*>(&stage);
  return simulated == nullptr ? nullptr : &simulated->simulation();
}

}  // namespace ortung

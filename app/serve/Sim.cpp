#include "Sim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "RefBoxLink.hpp"
#include "Rescue.hpp"
#include "Serving.hpp"
#include "ServingArguments.hpp"
#include "Trace.hpp"
#include "ortung/formats/TalkData.hpp"
#include "ortung/mcl_served/LocalizationCommands.hpp"
#include "ortung/mcl_served/LocalizedWorld.hpp"
#include "ortung/mcl_served/WorldTables.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/served/PlayerCommands.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/RecordedWorld.hpp"
#include "ortung/sim/RunDigest.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung::app {
namespace {

Simulation::Config configOf(const SimArguments& arguments) {
  Simulation::Config config;
  if (arguments.cycleMs) config.cycle = *arguments.cycleMs / 1000.0;
  config.seed = arguments.seed;
  config.noise = !arguments.noNoise;
  config.threads = arguments.threads;
  return config;
}

PlayerControl::Config playersOf(const SimArguments& arguments,
                                const std::function<void(const std::string&)>& onProblem) {
  return {arguments.playerBudgetMs / 1000.0, onProblem};
}

/// Returns the scene or world of the file, with further robots that wander about.
Scene sceneOf(const SimArguments& arguments) {
  Scene scene = Scene::open(arguments.world);
  const std::size_t more = arguments.robots.size() + arguments.players.size();
  const std::size_t all = scene.robots.size() + scene.players.size() + more;
  if (all > Scene::kMostRobots)
    throw UsageError(
        fmt::format("there are {} robots, {} of them by --robot and --player; expected at most {}",
                    all, more, Scene::kMostRobots));
  if (!arguments.referee.empty()) scene.referee = parseReferee(arguments.referee);
  for (const std::string& text : arguments.players) scene.players.push_back(parsePlayer(text));
  for (const std::filesystem::path& file : arguments.robots) {
    const std::string name = readRobot(file).name;
    std::string unused = name;
    for (int i = 2;; ++i) {
      const bool isTaken = std::any_of(scene.robots.begin(), scene.robots.end(),
                                       [&](const SceneRobot& one) { return one.name == unused; });
      if (!isTaken) break;
      unused = fmt::format("{}-{}", name, i);
    }
    SceneRobot robot;
    robot.file = file;
    robot.name = unused;
    robot.wanders = true;
    scene.robots.push_back(robot);
  }
  return scene;
}

/// Waits until real time has caught up with the simulation, according to the pace.
class Pacing {
 public:
  explicit Pacing(const ServingArguments& arguments)
      : speed_(arguments.speed), isFree_(arguments.freeRun), start_(Clock::now()) {}
  /// Waits; a signal ends it.
  void waitFor(double seconds) const {
    using Seconds = std::chrono::duration<double>;
    constexpr Seconds kLongest(0.05);
    while (!isFree_ && interruptSignal() == 0) {
      const Seconds left = Seconds(seconds / speed_) - (Clock::now() - start_);
      if (left <= Seconds::zero()) return;
      std::this_thread::sleep_for(std::min(kLongest, left));
    }
  }
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  double speed_;
  bool isFree_;
  Clock::time_point start_;
};

Outputs outputsOf(const SimArguments& arguments) {
  Outputs outputs(arguments.force);
  outputs.reads(arguments.world);
  for (const auto& robot : arguments.robots) outputs.reads(robot);
  outputs.writes("--record", arguments.record, OutputKind::kRecord);
  outputs.writes("--trace", arguments.trace, OutputKind::kTrace);
  return outputs;
}

/// Returns a referee's observations and decisions as a reading, for records.
Message messageOf(const std::vector<RefereeEvent>& events) {
  const Timestamp now = events.back().stamp;
  TalkData::Reading told;
  for (const RefereeEvent& event : events)
    told.messages.push_back({toSeconds(now - event.stamp), "referee", toText(event)});
  return {now, {"referee", "referee", "events"}, TalkData::encode(told)};
}

/// The outputs of a run. Plugins of robots need not be deterministic, and most runs end by a
/// signal, so everything is written at once.
struct Recording {
  std::string name;  ///< name of the recorded robot; "": none
  RobotNumber robot = 0;
  std::optional<RecordWriter> record;
  std::optional<Trace> trace;

  Recording(const SimArguments& arguments, const Outputs& outputs, const Scene& scene,
            SceneRun& run) {
    if (!arguments.trace.empty()) trace.emplace(outputs.ready(arguments.trace));
    if (arguments.record.empty()) return;
    const auto robots = run.simulation().robots();
    if (robots.empty()) throw UsageError("--record: there is no robot; see --robot and --player");
    name = !arguments.recorded.empty() ? arguments.recorded
           : scene.robots.empty()      ? robots.front()->config().name
                                       : scene.robots.front().name;
    const auto found = run.find(name);
    if (!found) throw UsageError("--record: there is no robot '" + name + "' to record");
    robot = robots[*found]->state().number;
    run.simulation().robots()[*found]->setWanted({}, true);  // all features
    record.emplace(
        outputs.ready(arguments.record),
        RecordNotes{run.simulation().world().fingerprint(), formatsOf(robots[*found]->container())},
        RecordWriter::Pace::kLive);
  }
  void add(const Simulation& simulation, const std::vector<RefereeEvent>& events) {
    if (!record) return;
    for (const Message& message : simulation.readingsOf(robot)) record->write(message);
    if (!events.empty()) record->write(messageOf(events));
    record->endMoment();
  }
  void commit() {
    if (record) record->commit();
    if (trace) trace->commit();
  }
};

void print(const std::vector<RefereeEvent>& events) {
  for (const RefereeEvent& event : events)
    fmt::print("{:9.2f} s  {}\n", toSeconds(event.stamp), toText(event));
  if (!events.empty()) flushOutput();
}

/// Ends the players of a run in which a plugin hangs.
void abandonPlayers(SceneRun& run) {
  constexpr std::chrono::seconds kPatience{2};
  if (!run.players().abandon(kPatience))
    warn(fmt::format("not all players have ended within {} s", kPatience.count()));
}

/// A served simulation whose referee a RefBox may control; it prints the events of the game.
class RefereedSimulation : public ServedSimulation {
 public:
  RefereedSimulation(const SimArguments& arguments, const Simulation::Config& config)
      : ServedSimulation(sceneOf(arguments), config, playersOf(arguments, warn)) {
    const Outputs outputs = outputsOf(arguments);
    if (!arguments.trace.empty()) trace_.emplace(outputs.ready(arguments.trace));
    if (!arguments.refBox.empty())
      box_.emplace(arguments.refBox, [this]() -> SceneRun& { return run(); });
  }
  void step() override {
    if (box_) box_->poll(clock_.elapsed());
    ServedSimulation::step();
    if (trace_) trace_->add(run().simulation());
    printEvents();
  }
  /// Observations and decisions of the referee in this cycle, for records.
  const std::vector<Message>& told() const { return told_; }
  void commit() {
    if (trace_) trace_->commit();
  }

 private:
  void printEvents() {
    told_.clear();
    if (eventsSoFar() == printed_) return;
    if (eventsSoFar() < printed_) printed_ = 0;  // after a reset
    std::vector<RefereeEvent> unsaid;
    for (const Event& event : events())
      if (event.number >= printed_) unsaid.push_back(event.event);
    printed_ = eventsSoFar();
    print(unsaid);
    if (!unsaid.empty()) told_.push_back(messageOf(unsaid));
  }

  std::vector<Message> told_;
  std::uint64_t printed_ = 0;
  Pacing clock_{ServingArguments{}};
  std::optional<RefBoxLink> box_;
  std::optional<Trace> trace_;
  Rescue farewell_{[this] { abandonPlayers(run()); }};
};

/// Returns the world with filters for those of its robots that can localize.
/// @param world the simulation, with what clients get besides
LocalizedWorld localized(ServedWorld& world, ServedSimulation& simulation,
                         const SimArguments& arguments) {
  LocalizedWorld::Config config;
  config.robotFile = [&simulation](RobotId id) -> std::filesystem::path {
    const SimRobot& robot = simulation.simRobot(id);
    const auto all = robot.container().all();
    const bool localizes = std::any_of(all.begin(), all.end(),
                                       [](const auto& feature) { return feature->localizes(); });
    return localizes ? robot.config().about.where() : "";
  };
  config.tables = arguments.tables.empty()
                      ? learnedTables(simulation.worldFile())
                      : givenTables(arguments.tables, simulation.describe().fingerprint);
  config.names = arguments.localize;
  config.seed = arguments.seed;
  try {
    return {world, config};
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--localize: ") + error.what());
  }
}

/// Only a world that is to keep up with a clock can be too slow for it.
PlayLimits playLimitsOf(const ServingArguments& serving) {
  constexpr double kMostLoad = 0.7;
  PlayLimits limits;
  if (!serving.freeRun && !serving.lockstep) limits.load = kMostLoad / serving.speed;
  return limits;
}

/// A run with nobody who looks on, and what it leaves behind.
class Playing {
 public:
  explicit Playing(const SimArguments& arguments)
      : arguments_(arguments),
        outputs_(outputsOf(arguments)),
        scene_(sceneOf(arguments)),
        factory_(PluginFactory::standardFolders()),
        run_(scene_, config(), factory_, playersOf(arguments, problemTaker())),
        recording_(arguments, outputs_, scene_, run_),
        duration_(arguments.duration ? arguments.duration : scene_.duration),
        rescue_([this] { recording_.commit(); }),
        farewell_([this] { abandonPlayers(run_); }),
        pacing_(arguments.serving) {
    if (!arguments.refBox.empty())
      box_.emplace(arguments.refBox, [this]() -> SceneRun& { return run_; });
  }

  /// Until its time is over, or a signal ends it.
  void run() {
    Progress progress("simulating", false);
    while (interruptSignal() == 0 && !(duration_ && now() > fromSeconds(*duration_))) {
      cycle();
      if (duration_ && cycles_ % 100 == 0) progress.update(toSeconds(now()) / *duration_);
      pacing_.waitFor(toSeconds(now()));
    }
    run_.players().endAll();  // now, so that what goes wrong is counted
  }

  void report() {
    const double elapsed = pacing_.elapsed();
    {
      const auto held = rescue_.hold();
      recording_.commit();
    }
    const double seconds = toSeconds(now());
    const Simulation& simulation = run_.simulation();
    fmt::print("{}: {:.2f} s in {} cycles, {} robots, {:.0f} times real time{}\n",
               printable(simulation.world().name()), seconds, cycles_, simulation.robots().size(),
               seconds / std::max(elapsed, 1e-9),
               recording_.record
                   ? fmt::format("; {} readings of {} in {}", recording_.record->messages(),
                                 recording_.name, printable(arguments_.record.string()))
                   : "");
    if (arguments_.digest) fmt::print("digest {:016x}\n", digest_.value());
  }

  bool hadProblems() const { return problems_ > 0; }

 private:
  std::function<void(const std::string&)> problemTaker() {
    return [this](const std::string& problem) {
      warn(problem);
      ++problems_;
    };
  }

  Simulation::Config config() {
    Simulation::Config config = configOf(arguments_);
    config.onProblem = problemTaker();
    return config;
  }

  Timestamp now() { return run_.simulation().now(); }

  void cycle() {
    if (recording_.trace) {
      const auto held = rescue_.hold();
      recording_.trace->add(run_.simulation());
    }
    if (box_) box_->poll(pacing_.elapsed());
    run_.step();
    const std::vector<RefereeEvent> events =
        run_.referee() != nullptr ? run_.referee()->takeEvents() : std::vector<RefereeEvent>();
    print(events);
    if (arguments_.digest) {
      digest_.add(run_);
      for (const RefereeEvent& event : events) digest_.add(event);
    }
    ++cycles_;
    const auto held = rescue_.hold();
    recording_.add(run_.simulation(), events);
  }

  const SimArguments& arguments_;
  std::size_t problems_ = 0;
  const Outputs outputs_;
  const Scene scene_;
  PluginFactory factory_;
  SceneRun run_;
  Recording recording_;
  std::optional<RefBoxLink> box_;
  const std::optional<double> duration_;
  Rescue rescue_;
  Rescue farewell_;
  const Pacing pacing_;
  std::size_t cycles_ = 0;
  RunDigest digest_;
};

int play(const SimArguments& arguments) {
  Playing playing(arguments);
  playing.run();
  playing.report();
  return playing.hadProblems() ? 1 : 0;
}

}  // namespace

int runSim(const SimArguments& arguments) {
  const ServingArguments& serving = arguments.serving;
  checkPace(serving);
  if (!serving.isServing()) {
    if (!serving.recordInto.empty()) throw UsageError("--record-into is for --listen and --view");
    if (serving.lockstep || !serving.control.empty() || !serving.tokens.empty())
      throw UsageError("--lockstep, --allow-control and --token-file are for --listen and --view");
    if (!arguments.localize.empty() || !arguments.tables.empty())
      throw UsageError("--localize and --tables are for --listen and --view");
    return play(arguments);
  }
  if (!arguments.record.empty() || arguments.duration || arguments.digest)
    throw UsageError(
        "--record, --duration and --digest do not fit --listen: clients keep their own records, "
        "and "
        "the server runs until it is stopped");
  Simulation::Config config = configOf(arguments);
  config.onProblem = warn;
  ClientRecords records(serving);
  RefereedSimulation simulation(arguments, config);
  RecordedWorld recorded(simulation, records.recordings(),
                         {.also = [&simulation] { return simulation.told(); }});
  LocalizedWorld world = localized(recorded, simulation, arguments);
  std::vector<BoardCommand> commands = playerCommands(simulation, playLimitsOf(serving));
  commands.push_back(recordCommand(recorded));
  for (BoardCommand& command : localizationCommands(world)) commands.push_back(std::move(command));
  serve(world, arguments.serving, std::move(commands));
  simulation.commit();
  return 0;
}

}  // namespace ortung::app

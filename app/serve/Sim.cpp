#include "Sim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
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
#include "ortung/base/Angles.hpp"
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

/// A table of the places of all bodies over time, which grows during the simulation.
class Trace {
 public:
  explicit Trace(const std::filesystem::path& file) : file_(file) {}
  void add(const Simulation& simulation) {
    constexpr Timestamp kPeriod = 50'000;                              // time between lines [us]
    if (simulation.now() + kPeriod < next_) next_ = simulation.now();  // it has started over
    if (simulation.now() < next_) return;
    next_ += kPeriod;
    for (const auto& robot : simulation.robots()) {
      std::string states;
      const auto& manipulators = robot->shape().manipulators;
      for (std::size_t i = 0; i < manipulators.size(); ++i)
        states += fmt::format("{}{}={}", i == 0 ? "" : ";", manipulators[i].name,
                              manipulators[i].states[robot->manipulatorStates()[i]].name);
      line(simulation.now(), "robot", robot->config().name, robot->state().pose,
           robot->state().velocity, states);
    }
    for (const Simulation::Thing& thing : simulation.things())
      line(simulation.now(), thing.kind, thing.name, thing.pose, thing.velocity, "");
    file_.write(text_);
    file_.publish();
    text_.clear();
  }
  void commit() {
    file_.write(text_);
    file_.commit();
  }

 private:
  void line(Timestamp now, const std::string& kind, std::string name, const Pose2& pose,
            const Twist& velocity, const std::string& states) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ',' || c == '"' || c == '\n'; }, '_');
    text_ += fmt::format("{:.3f},{},{},{:.4f},{:.4f},{:.3f},{:.4f},{:.4f},{:.3f},{}\n",
                         toSeconds(now), kind, name, pose.x, pose.y, degrees(pose.theta),
                         velocity.x, velocity.y, degrees(velocity.theta), states);
  }
  NewFile file_;
  Timestamp next_ = 0;
  std::string text_ = "time_s,kind,name,x_m,y_m,theta_deg,vx_m_s,vy_m_s,w_deg_s,manipulators\n";
};

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
    record.emplace(outputs.ready(arguments.record), run.simulation().world().fingerprint(),
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

int play(const SimArguments& arguments) {
  const Outputs outputs = outputsOf(arguments);
  const Scene scene = sceneOf(arguments);
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation::Config config = configOf(arguments);
  std::size_t problems = 0;
  config.onProblem = [&problems](const std::string& problem) {
    warn(problem);
    ++problems;
  };
  SceneRun run(scene, config, factory, playersOf(arguments, config.onProblem));
  Simulation& simulation = run.simulation();
  Recording recording(arguments, outputs, scene, run);
  std::optional<RefBoxLink> box;
  if (!arguments.refBox.empty())
    box.emplace(arguments.refBox, [&run]() -> SceneRun& { return run; });
  const std::optional<double> duration = arguments.duration ? arguments.duration : scene.duration;
  Rescue rescue([&] { recording.commit(); });
  const Pacing pacing(arguments.serving);
  std::size_t cycles = 0;
  RunDigest digest;
  {
    Progress progress("simulating", false);
    while (interruptSignal() == 0 && !(duration && simulation.now() > fromSeconds(*duration))) {
      if (recording.trace) {
        const auto held = rescue.hold();
        recording.trace->add(simulation);
      }
      if (box) box->poll(pacing.elapsed());
      run.step();
      const std::vector<RefereeEvent> events =
          run.referee() != nullptr ? run.referee()->takeEvents() : std::vector<RefereeEvent>();
      print(events);
      if (arguments.digest) {
        digest.add(run);
        for (const RefereeEvent& event : events) digest.add(event);
      }
      ++cycles;
      {
        const auto held = rescue.hold();
        recording.add(simulation, events);
      }
      if (duration && cycles % 100 == 0) progress.update(toSeconds(simulation.now()) / *duration);
      pacing.waitFor(toSeconds(simulation.now()));
    }
  }
  const double elapsed = pacing.elapsed();
  {
    const auto held = rescue.hold();
    recording.commit();
  }
  const double seconds = toSeconds(simulation.now());
  fmt::print("{}: {:.2f} s in {} cycles, {} robots, {:.0f} times real time{}\n",
             printable(simulation.world().name()), seconds, cycles, simulation.robots().size(),
             seconds / std::max(elapsed, 1e-9),
             recording.record
                 ? fmt::format("; {} readings of {} in {}", recording.record->messages(),
                               recording.name, printable(arguments.record.string()))
                 : "");
  if (arguments.digest) fmt::print("digest {:016x}\n", digest.value());
  return problems == 0 ? 0 : 1;
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
  std::vector<BoardCommand> commands = playerCommands(simulation);
  commands.push_back(recordCommand(recorded));
  for (BoardCommand& command : localizationCommands(world)) commands.push_back(std::move(command));
  serve(world, arguments.serving, std::move(commands));
  simulation.commit();
  return 0;
}

}  // namespace ortung::app

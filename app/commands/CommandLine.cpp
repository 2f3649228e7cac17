#include "CommandLine.hpp"

#include <fmt/format.h>

#include <memory>

#include "BenchmarkCommands.hpp"
#include "CalibrateCommands.hpp"
#include "Commands.hpp"
#include "Console.hpp"
#include "DeviceCommands.hpp"
#include "ExportCommands.hpp"
#include "LearnCommands.hpp"
#include "LocalizationCommands.hpp"
#include "OptionBuilder.hpp"
#include "ServingOptions.hpp"

namespace ortung::app {
namespace {

void addImport(Builder& build, CLI::App& app) {
  const auto a =
      build.command<ImportArguments>(app, "import", "Turn a foreign log into a record",
                                     "ortung import mrclam data/ds6 --out ds6-3.rec --robot 3 "
                                     "--world ds6.toml --robot-file ds6-3.toml",
                                     runImport);
  // Made when the help is asked for, and then knows the kind that stands before --help.
  build.app().footer([a] { return importHelp(a->kind.substr(0, a->kind.find(':'))); });
  build.option("kind", a->kind, "Kind of source, or KIND:SOURCE?key=value; see below")->required();
  build.option("source", a->source, "File or folder to read, if KIND does not name it");
  build.option("--out", a->out, "Record file to write")->required();
  build.option("--world", a->world,
               "Also write the world file, and the maps that it names beside it");
  build.option("--robot-file", a->robotFile, "Also write a robot file that fits");
  build.option("--option", a->options, "key=value, an option of the source; may be given again")
      ->expected(1)
      ->take_all();
  for (const char* key : {"robot", "laser_x"}) {
    const bool isRobot = std::string_view(key) == "robot";
    build.app().add_option_function<std::string>(
        isRobot ? "--robot" : "--laser-x",
        [a, key](const std::string& value) {
          a->options.push_back(fmt::format("{}={}", key, value));
        },
        isRobot ? "Number of the robot; short for --option robot=N"
                : "Place of the laser on the robot's x axis [m]; short for --option laser_x=M");
  }
  build.option("--with-robot", a->withRobot, "Robot file to read, for sources that need one (sim)");
  build.flag("--force", a->force,
             "Replace world and robot files that exist, and files that hold something else than "
             "what is written (never what the run reads)");
  build.flag("--progress", a->progress, kProgress);
}

void addShow(Builder& build, CLI::App& app) {
  const auto a = build.command<ShowArguments>(
      app, "show", "Draw a feature's expectation, or the probability of a reading, over the field",
      "ortung show hall.ortung --robot robot.toml --feature 'LMS200/LRF/*' --record run.rec --at "
      "12.5 --out heat.png",
      runShow);
  build.option("tables", a->tables, "Table file of `ortung learn`")->required();
  build.option("--robot", a->robot, "Robot file (TOML)")->required();
  build
      .option("--feature", a->features,
              "model/type/feature, * for any; given again: the product of all that match")
      ->required()
      ->expected(1)
      ->take_all();
  build.option("--out", a->out, "Picture to write (PNG)")->required();
  build.option("--record", a->record, "Record with the reading to weigh");
  build.option("--source", a->source, "Or any source with the reading to weigh");
  build.option("--at", a->at, "Time of the reading after the first one [s]")
      ->check(within(0.0, 1e9))
      ->capture_default_str();
  build
      .option("--heading", a->headingDeg,
              "Heading of the robot [degrees]; default: 0 without a reading, else the best of all")
      ->check(within(-360.0, 360.0));
  build.option("--beam", a->beam, "Which of the feature's values, from 0")
      ->check(within(0, 8191))
      ->capture_default_str();
  build
      .option(
          "--scale", a->scale,
          "Colours of probabilities: linear, log, or auto: log where linear shows next to nothing")
      ->check(CLI::IsMember({"auto", "linear", "log"}))
      ->capture_default_str();
  build.flag("--log", a->logarithmic, "Short for --scale log");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addCheck(Builder& build, CLI::App& app) {
  const auto a = build.command<CheckArguments>(
      app, "check",
      "Say what worlds, robots, tables and records contain, and what is wrong with them",
      "ortung check hall.ortung --world hall.toml --robot robot.toml", runCheck);
  build.option("files", a->files, "Files; their contents say what they are")->required();
  build.option("--world", a->world, "World that the tables must have been learned in");
  build.option("--robot", a->robot, "Robot that the tables must have been learned for");
  build.flag("--mend", a->mend,
             "Cut off what a killed recorder left of the last moment of a record");
}

void addDemo(Builder& build, CLI::App& app) {
  const auto a = build.command<DemoArguments>(
      app, "demo", "A robot that finds its place on a soccer field, in a web browser",
      "ortung demo", runDemo);
  addDoor(build, a->serving);
  addRecording(build, a->serving);
}

void addSim(Builder& build, CLI::App& app) {
  const auto a = build.command<SimArguments>(
      app, "sim", "Simulate a world or play a scene; with --listen, serve it to clients",
      "ortung sim maps/scenes/kick.toml --duration 60 --free-run --record run.rec\n"
      "  ortung sim maps/fields/f2000.toml --listen 7777",
      runSim);
  build.option("world", a->world, "World or scene file (TOML)")->required();
  build
      .option("--robot", a->robots,
              "Robot file (TOML) of a robot that wanders about; may be given again")
      ->expected(1)
      ->take_all();
  build
      .option(
          "--player", a->players,
          "PLUGIN[:key=value&key=value...][@TEAM]: a player on a robot of its own, e.g. "
          "wander:robot=maps/robots/pioneer.toml&speed_m_s=0.5@blue; robot, name, start (x,y,deg) "
          "and stage (yes, no) are for all, `ortung plugins` shows the others; may be given again")
      ->expected(1)
      ->take_all();
  build.option("--referee", a->referee,
               "PLUGIN[:key=value&key=value...]: who sees to the rules, e.g. soccer:league=msl");
  build.option("--refbox", a->refBox,
               "HOST[:PORT][@TEAM]: a RefBox of the Middle Size League leads the game; it is told "
               "of TEAM (blue). With --referee soccer:control=orders");
  build
      .option("--player-budget-ms", a->playerBudgetMs,
              "What a player may take of a processor for one call before it is stopped [ms]; 0: as "
              "long as it likes")
      ->check(within(0.0, 1e6))
      ->capture_default_str();
  build
      .option("--duration", a->duration,
              "Time to simulate [s]; default: the scene's, or until a signal")
      ->check(within(0.0, 1e6));
  build.option("--record", a->record, "Write all readings of one robot as a record");
  build.option("--recorded", a->recorded, "Name of the robot to record; default: the first");
  build.option("--trace", a->trace, "Write where everything was, 20 times a second, as CSV");
  build.flag("--digest", a->digest,
             "Print a hash of all that happened: the same in every run that did the same");
  build.option("--threads", a->threads, "Threads that sense; the result does not depend on it")
      ->check(within(1, 256));
  build.option("--seed", a->seed, "Seed of all random numbers")->capture_default_str();
  build
      .option("--cycle-ms", a->cycleMs,
              "Time between two steps of the simulation [ms]; default: the world's")
      ->check(within(0.1, 1000.0));
  build.flag("--no-noise", a->noNoise, "Sensors and odometry without noise");
  build.flag("--force", a->force, kForce);
  build
      .option("--localize", a->localize,
              "With --listen: names of robots (NAME,NAME,... or all) that are localized from the "
              "beginning, for clients to see; these may begin and end it (LOCALIZE)")
      ->delimiter(',');
  build.option(
      "--tables", a->tables,
      "Table file for that, of `ortung learn`; default: learned when the first one begins");
  addServing(build, a->serving);
  addRecording(build, a->serving);
}

#ifdef ORTUNG_HAS_PLAY
void addPlay(Builder& build, CLI::App& app) {
  const auto a = build.command<PlayArguments>(
      app, "play", "Let a player play on the field of a server, as it does in the simulator",
      "ortung play 'seeker:robot=pioneer.toml@blue' --server 127.0.0.1:7777", runPlay);
  build
      .option(
          "player", a->player,
          "PLUGIN[:key=value&key=value...][@TEAM]; robot, name and start (x,y,deg) are for all, "
          "`ortung plugins` shows the others")
      ->required();
  build.option("--server", a->server, "HOST:PORT of `ortung sim --listen`")->required();
  build.option("--token-file", a->tokens,
               "File with a line 'NAME TOKEN' for the robot's name, or * for any; default: "
               "$ORTUNG_TOKEN");
  build.option("--tables", a->tables,
               "Table file of `ortung learn`: what the robot's features expect, and the field");
  build.flag("--lockstep", a->lockstep,
             "The world goes on only when the player has acted (the server's --lockstep)");
  build
      .option("--player-budget-ms", a->budgetMs,
              "What the player may take of a processor for one call before it is stopped [ms]; 0: "
              "as long as it likes")
      ->check(within(0.0, 1e6))
      ->capture_default_str();
  build
      .option("--duration", a->duration,
              "Time to play [s]; default: until the player ends, or a signal")
      ->check(within(0.0, 1e6));
  build.option("--seed", a->seed, "Seed of the player's random numbers")->capture_default_str();
}
#endif

void addServe(Builder& build, CLI::App& app) {
  const auto a = build.command<ServeArguments>(
      app, "serve", "Serve a record to clients as if it were a simulation",
      "ortung serve run.rec --listen 7777", runServe);
  build.option("record", a->record, "Record file")->required();
  build.flag("--repeat", a->repeats, "Start over at the end");
  addServing(build, a->serving);
  addRecording(build, a->serving);
}

void addPlugins(Builder& build, CLI::App& app) {
  const auto a = build.command<PluginsArguments>(
      app, "plugins", "List the plugins that were found; exit code 1 if one is broken",
      "ORTUNG_PLUGIN_PATH=~/my-plugins ortung plugins", runPlugins);
  build.option("--timeout", a->timeout, "How long a library may take to load [s]")
      ->check(within(0.1, 3600.0))
      ->capture_default_str();
  build.option("--inside", a->inside, "")->group("");  // not shown: the command's own
}

/// One line instead of CLI11's two.
/// @param first the first word behind the program's name, or ""
int printError(const CLI::App& app, const CLI::ParseError& error, const std::string& first) {
  constexpr int kWrongUsage = 2;
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  std::string name = "ortung";
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    name += " " + at->get_name();
  }
  setCommandName(name);
  const bool unknown = app.get_subcommands().empty() && !first.empty() && first[0] != '-';
  const std::string what = unknown ? "there is no subcommand '" + first + "'" : error.what();
  fail(what + "; see `" + name + " --help`");
  return kWrongUsage;
}

std::string quoted(const std::string& word) {
  const bool plain =
      !word.empty() &&
      word.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=+@%") ==
          std::string::npos;
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

ParsedCommand parseCommandLine(int argc, char** argv) {
  ParsedCommand parsed;
  std::string commandLine = "ortung";
  for (int i = 1; i < argc; ++i) commandLine += " " + quoted(argv[i]);

  CLI::App app("Ortung: learn what sensors see, and localize with it.", "ortung");
  app.set_version_flag("--version", "ortung " ORTUNG_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Example:\n  ortung learn --world maps/fields/f2000.toml --robot maps/robots/pioneer.toml "
      "--out f2000.ortung");
  Builder build(parsed);
  addLearn(build, app);
  addLearnMotion(build, app);
  addTrainMotion(build, app);
  addEval(build, app, commandLine);
  addCompare(build, app);
  addLocalize(build, app);
  addView(build, app);
  addDemo(build, app);
  addImport(build, app);
  addExport(build, app);
  addShow(build, app);
  addCheck(build, app);
  addSim(build, app);
#ifdef ORTUNG_HAS_PLAY
  addPlay(build, app);
#endif
  addServe(build, app);
#ifdef ORTUNG_HAS_DEVICES
  addRobot(build, app);
  addEmulate(build, app);
#endif
  addBenchmark(build, app);
  addCalibrate(build, app);
  addPlugins(build, app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    parsed.run = nullptr;
    parsed.exitCode = printError(app, error, argc > 1 ? argv[1] : "");
  }
  return parsed;
}

}  // namespace ortung::app

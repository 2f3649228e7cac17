#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// One struct of arguments and one function a subcommand. The functions print results to stdout
/// and throw what went wrong; main() turns that into a message and an exit code.
namespace ortung::app {

struct LearnArguments {
  std::filesystem::path world;
  std::filesystem::path robot;
  std::filesystem::path out;
  double cell = 0.1;            ///< [m]
  double headingStepDeg = 2.0;  ///< [degrees]
  std::string area = "auto";    ///< "auto", "all" or "x,y" [m]: which part of the floor
  unsigned threads = 1;
  bool force = false;  ///< overwrite files of other kinds
  bool progress = false;
};
int runLearn(const LearnArguments& arguments);

struct ExportImagesArguments {
  std::string source;  ///< "sim:FILE?key=value", or a record with pictures
  std::filesystem::path robot;
  std::filesystem::path out;    ///< folder
  std::filesystem::path world;  ///< of a record, for what its pictures show; "" for none
  std::string camera;           ///< model/type/feature; "": all
  double every = 1;             ///< picture of each camera
  double count = 1e9;           ///< pictures at most
  std::optional<double> variation;
  std::optional<std::uint64_t> seed;  ///< of the first picture's look; each has the next one
  bool anywhere = false;              ///< from places at random
  bool force = false;
  bool progress = false;
};
int runExportImages(const ExportImagesArguments& arguments);

struct LearnMotionArguments {
  std::vector<std::string> sources;  ///< records, or "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path out;
  std::string plugin;            ///< the motion model to teach; "": that of the robot file ...
  std::filesystem::path motion;  ///< ... or a file with [motion] to begin with; "" for none
  double interval = 0.5;         ///< of the shortest pieces [s]
  double from = 0.0;             ///< part of each log to learn from, as shares of its time
  double to = 1.0;
  std::optional<double> delay;  ///< of odometry [s]; nothing: learned
  bool force = false;           ///< overwrite files of other kinds
  bool progress = false;
};
int runLearnMotion(const LearnMotionArguments& arguments);

struct TrainMotionArguments {
  std::vector<std::string> sources;  ///< records, or "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path out;
  std::string commandsFrom = "auto";  ///< "velocities" or "motion_data" of odometry, or "auto"
  double step = 0.1;                  ///< of a prediction [s]
  std::size_t commands = 5;           ///< newest ones that the network sees
  std::string hidden = "24,24";       ///< widths of layers
  std::size_t iterations = 300;
  double holdOut = 0.25;  ///< share of each log at its end
  std::uint64_t seed = 1;
  bool force = false;  ///< overwrite files of other kinds
  bool progress = false;
};
int runTrainMotion(const TrainMotionArguments& arguments);

/// What eval and localize have in common.
struct LocalizationArguments {
  std::string source;  ///< "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path tables;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> particles;
  std::optional<unsigned> threads;
  std::string start = "global";  ///< "global", "truth" or "x,y,theta_deg"
  std::string startSigma = "0.3,10";
  std::string motion;          ///< file, "turn_per_turn,turn_per_m,way_per_m,way_per_turn" or ""
  std::string filter = "mcl";  ///< "mcl" or "grid"
  std::string grid = "0.1,5";  ///< of the grid filter: cell [m], step of headings [degrees]
  bool besideGrid = false;     ///< MCL, compared with the grid filter
  bool anyWorld = false;
  bool publish = false;  ///< put estimates into the container, for whoever reads that
  bool force = false;    ///< overwrite files of other kinds
  bool progress = false;
};

struct EvalArguments {
  LocalizationArguments localization;          ///< its source is not used
  std::vector<std::string> localizationWords;  ///< options of localization as they were given
  std::vector<std::string> sources;            ///< that share robot and tables
  std::size_t runs = 1;                        ///< of each source
  std::size_t kidnaps = 0;                     ///< cases that are made of each source
  std::size_t wakeUps = 0;
  std::optional<double> teleport;  ///< rate of kidnaps within a run [1/m]
  std::filesystem::path json;      ///< "" for none
  std::filesystem::path report;    ///< "" for none
  std::filesystem::path record;    ///< "" for none
  std::string convergedWithin = "0.5,15";
  std::vector<std::string> faults;  ///< "WHAT=FAULT[:VALUE][@FROM-TO]"
  std::string commandLine;          ///< for the report
  bool isViewing = false;           ///< show the run afterwards
  std::filesystem::path bound;      ///< world of all sources, whose truth is exact; "" for none
};
int runEval(const EvalArguments& arguments);

struct CompareArguments {
  std::filesystem::path before;  ///< JSON of eval
  std::filesystem::path after;
  std::filesystem::path json;  ///< "" for none
  bool force = false;          ///< overwrite files of other kinds
};
int runCompare(const CompareArguments& arguments);

struct LocalizeArguments {
  LocalizationArguments localization;
  std::filesystem::path out;     ///< "": stdout
  std::filesystem::path belief;  ///< "" for none
  std::optional<double> rate;    ///< of poses [Hz]; without: one an update
  std::string format = "text";   ///< "text", "json" or "tum"
  std::filesystem::path truth;   ///< ground truth of the source as TUM has it; "" for none
};
int runLocalize(const LocalizeArguments& arguments);

struct ImportArguments {
  std::string kind;
  std::string source;
  std::filesystem::path out;
  std::filesystem::path world;       ///< "" for none
  std::filesystem::path robotFile;   ///< "" for none
  std::vector<std::string> options;  ///< "key=value"
  std::filesystem::path withRobot;   ///< robot file for sources that need one; "" for none
  bool force = false;
  bool progress = false;
};
int runImport(const ImportArguments& arguments);
/// What the help of import says of a kind of source, or which kinds there are if it is "".
std::string importHelp(const std::string& kind);

struct ExportRawlogArguments {
  std::string source;
  std::filesystem::path robot;
  std::filesystem::path out;
  std::filesystem::path truth;  ///< "" for none
  bool force = false;
  bool progress = false;
};
int runExportRawlog(const ExportRawlogArguments& arguments);

struct ExportMcapArguments {
  std::string source;
  std::filesystem::path robot;
  std::filesystem::path out;
  std::filesystem::path tables;   ///< of which the map is drawn; "" for none
  std::filesystem::path world;    ///< likewise
  double cell = 0.05;             ///< of a world's map [m]
  double height = 0.3;            ///< of the plane that is drawn [m]
  std::string mapFrame = "best";  ///< "best", "truth" or "none"
  bool force = false;
  bool progress = false;
};
int runExportMcap(const ExportMcapArguments& arguments);

struct ExportMapArguments {
  std::filesystem::path world;
  std::filesystem::path out;
  double cell = 0.05;   ///< [m]
  double height = 0.3;  ///< of the plane that is drawn [m]
  bool force = false;
};
int runExportMap(const ExportMapArguments& arguments);

struct ShowArguments {
  std::filesystem::path tables;
  std::filesystem::path robot;
  std::vector<std::string> features;  ///< "model/type/feature", any of them
  std::filesystem::path out;
  std::filesystem::path record;      ///< "" for none
  std::string source;                ///< "" for none
  double at = 0.0;                   ///< of the reading [s] after the first one
  std::optional<double> headingDeg;  ///< [degrees]
  std::size_t beam = 0;
  std::string scale = "auto";  ///< of probabilities: "auto", "linear" or "log"
  bool logarithmic = false;    ///< "log", whatever `scale` says
  bool force = false;          ///< overwrite files of other kinds
  bool progress = false;
};
int runShow(const ShowArguments& arguments);

struct CheckArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path world;  ///< "" for none
  std::filesystem::path robot;  ///< "" for none
  bool mend = false;            ///< cut off what a killed recorder left of its last moment
};
int runCheck(const CheckArguments& arguments);

/// What sim and serve have in common when they serve clients.
struct ServingArguments {
  std::optional<std::string> listen;  ///< "[ADDRESS:]PORT"
  std::vector<std::string> control;   ///< names of clients that may control, "*": all
  std::filesystem::path tokens;       ///< file with a line "NAME TOKEN" for each; "" for none
  double idle = 30.0;                 ///< [s] without a line from a client
  unsigned clients = 256;             ///< at a time
  unsigned clientsOfAddress = 128;    ///< of them from one computer
  double speed = 1.0;                 ///< times real time
  bool freeRun = false;
  bool lockstep = false;
  bool isViewing = false;            ///< with the page for browsers
  bool opensBrowser = true;          ///< and shows it, where there is a desktop
  std::vector<std::string> hosts;    ///< further names of this computer
  std::filesystem::path recordInto;  ///< folder for records that clients begin; "": none
  bool isServing() const { return isViewing || listen; }
};

struct ServeArguments {
  std::filesystem::path record;
  bool repeats = false;
  ServingArguments serving;
};
int runServe(const ServeArguments& arguments);

struct SimArguments {
  std::filesystem::path world;                ///< a world or a scene
  std::vector<std::filesystem::path> robots;  ///< robot files: they wander about
  std::vector<std::string> players;           ///< as parsePlayer() reads them
  std::string referee;                        ///< as parseReferee() reads it; "": nobody
  std::string refBox;                         ///< HOST[:PORT][@TEAM]; "": none
  double playerBudgetMs = 1000.0;             ///< of a processor's time for one call; 0: none
  std::optional<double> duration;             ///< [s]; default: the scene's, or until a signal
  std::filesystem::path record;               ///< "" for none
  std::filesystem::path trace;                ///< "" for none
  std::string recorded;                       ///< name of the robot to record; "": the first
  bool digest = false;                        ///< print a hash of all that happened
  unsigned threads = 1;
  std::uint64_t seed = 1;
  std::optional<double> cycleMs;  ///< default: the world's
  bool noNoise = false;
  bool force = false;                 ///< overwrite files of other kinds
  std::vector<std::string> localize;  ///< names of robots to localize for clients; "all"
  std::filesystem::path tables;       ///< for that; "": they are learned
  ServingArguments serving;
};
int runSim(const SimArguments& arguments);

struct ViewArguments {
  std::vector<std::string> sources;    ///< records, or "KIND:PATH?key=value"
  std::filesystem::path world;         ///< whose field is drawn; "": that of the tables
  LocalizationArguments localization;  ///< its source is not used; tables "": nothing is localized
  ServingArguments serving;
};
int runView(const ViewArguments& arguments);

struct ExportHtmlArguments {
  ViewArguments runs;  ///< what is in it; it is not served
  std::filesystem::path out;
  bool force = false;
};
int runExportHtml(const ExportHtmlArguments& arguments);

struct DemoArguments {
  bool once = false;  ///< without a page, until the robot has found its place
  ServingArguments serving;
};
int runDemo(const DemoArguments& arguments);

struct RobotArguments {
  LocalizationArguments localization;  ///< tables "": it does not localize; no source
  std::filesystem::path dev;           ///< in place of /dev; "": the real one
  std::filesystem::path record;        ///< "" for none
  std::filesystem::path out;           ///< poses; "" for none
  std::optional<double> duration;      ///< [s]; default: until a signal
  ServingArguments serving;
};
int runRobot(const RobotArguments& arguments);

struct EmulateArguments {
  std::string kind = "all";  ///< "sick", "hokuyo", "base", "lines", or all of the robot file
  std::filesystem::path robot;
  std::filesystem::path world;      ///< "": a source is given
  std::string source;               ///< "": a world is given
  std::filesystem::path dev;        ///< folder for links named like the ports; "": none
  std::filesystem::path link;       ///< of a single device; "": none
  std::optional<unsigned> tcp;      ///< port of a single device
  std::optional<unsigned> baud;     ///< of a single device
  std::vector<std::string> faults;  ///< "[DEVICE=]KIND[:VALUE][@FROM-TO]"
  double clockOffset = 1000.0;      ///< of the devices' clocks [s]
  double clockDriftPpm = 0.0;
  double speed = 1.0;
  bool waits = false;  ///< time begins when all devices have been asked to measure
  std::uint64_t seed = 1;
};
int runEmulate(const EmulateArguments& arguments);
/// What goes wrong with emulated devices, for help.
std::string emulateHelp();

struct PlayArguments {
  std::string player;              ///< as parsePlayer() reads it
  std::string server;              ///< "HOST:PORT"
  std::filesystem::path tokens;    ///< with a line 'NAME TOKEN'; "" for none
  std::filesystem::path tables;    ///< "" for none
  double budgetMs = 1000.0;        ///< of a processor's time for one call; 0: none
  std::optional<double> duration;  ///< [s]; default: as long as the player likes
  std::uint64_t seed = 1;
  bool lockstep = false;
};
int runPlay(const PlayArguments& arguments);

struct GoalkeeperBenchmarkArguments {
  std::vector<std::string> keepers;   ///< policies, or players as parsePlayer() reads them
  std::vector<std::string> strikers;  ///< kinds, or players
  std::vector<std::string> sees;      ///< ways to see that each keeper plays with; none: its own
  std::uint64_t episodes = 1000;      ///< of each pair
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::string shard = "1/1";   ///< "I/N"
  std::filesystem::path json;  ///< "" for none
  std::filesystem::path html;  ///< "" for none
  bool force = false;          ///< overwrite files of other kinds
  bool progress = false;
};
int runGoalkeeperBenchmark(const GoalkeeperBenchmarkArguments& arguments);

struct BenchmarkVerifyArguments {
  std::filesystem::path file;
  std::uint64_t sample = 500;  ///< episodes of all pairs together
  std::uint64_t seed = 1;      ///< of the choice
  unsigned threads = 1;
  bool progress = false;
};
int runBenchmarkVerify(const BenchmarkVerifyArguments& arguments);

struct BenchmarkMergeArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path json;  ///< "" for none
  std::filesystem::path html;  ///< "" for none
  bool force = false;          ///< overwrite files of other kinds
};
int runBenchmarkMerge(const BenchmarkMergeArguments& arguments);

struct PluginsArguments {
  double timeout = 10.0;         ///< for a library to load [s]
  std::filesystem::path inside;  ///< set in a process of its own for this library
};
int runPlugins(const PluginsArguments& arguments);

}  // namespace ortung::app

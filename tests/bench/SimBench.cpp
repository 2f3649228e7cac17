// Simulated seconds a second of computing time: our simulator beside bare Box2D with its own ray
// cast, in the same run, and matches.
// sim_bench [SECONDS]: how long each is measured at least.
// sim_bench match CYCLES: one match that nobody reads, for profilers.
#include <stdio.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>

#include "ArenaStarts.hpp"
#include "Figures.hpp"
#include "Measured.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung::bench {
namespace {

std::string robotToml(bool hasLaser) {
  std::string toml = R"(
[robot]
radius_m = 0.29
mass_kg = 10
[[body]]
center_m = [0, 0]
size_m = [0.4, 0.4]
[drive]
acceleration_m_s2 = 100
turn_acceleration_deg_s2 = 36000
max_turn_deg_s = 360
[[sensor]]
)";
  return toml + (hasLaser ? "plugin = \"lrf\"\nbeams = 180\nfov_deg = 180\nmax_range_m = 8\n"
                            "period_s = 0.1\n"
                          : "plugin = \"odometry\"\nperiod_s = 3600\n");
}

/// The arena in our simulator.
class Ours {
 public:
  Ours(std::size_t robots, bool hasLaser, PluginFactory& factory)
      : simulation_(readWorld(ORTUNG_MAPS "/fields/boxes18x12.toml"),
                    {.cycle = kCycle, .seed = 1, .noise = false}) {
    RobotConfig config = readRobot(parseToml(robotToml(hasLaser), "arena robot"));
    for (std::size_t i = 0; i < robots; ++i) {
      const ArenaStart& start = kArenaStarts[i];
      config.name = "robot" + std::to_string(i);
      SimRobot& robot = simulation_.addRobot(
          config, factory,
          {start.x, start.y, wrapAngle(start.thetaDeg * std::numbers::pi / 180.0)});
      robot.drive().setTranslationalVelocity(0.3);
      robot.drive().setRotationalVelocity(1.0);
    }
  }
  void step() { simulation_.step(); }
  /// Mean range of the last scans [m].
  double meanRange() {
    double sum = 0.0;
    std::size_t beams = 0;
    for (const auto& robot : simulation_.robots()) {
      const auto scan = robot->container().get<ScanData>({.type = "LRF"});
      for (const float range : scan->ranges) {
        sum += std::isfinite(range) ? static_cast<double>(range) : 8.0;
        ++beams;
      }
    }
    return sum / static_cast<double>(beams);
  }

 private:
  Simulation simulation_;
};

struct Pair {
  double bare, ours;
};

void report(Figures& figures, const char* what, std::size_t robots, const Pair& pair, double aim) {
  const std::string name = std::string(what) + "/" + std::to_string(robots);
  figures.put(name, "bare", pair.bare);
  figures.put(name, "ours", pair.ours);
  figures.put(name, "x_bare", pair.ours / pair.bare);
  std::printf("%-13s %4zu %12.1f %12.1f %8.2f   %s %.1f\n", what, robots, pair.bare, pair.ours,
              pair.ours / pair.bare, pair.ours / pair.bare >= aim ? "reaches" : "MISSES", aim);
}

/// Simulated seconds a second in bare Box2D, physics alone and with rays, and its mean range [m].
struct Bare {
  double physics = 0.0, withRays = 0.0, meanRange = 0.0;
};

Bare measureBare(std::size_t robots, double seconds) {
  const std::string command =
      ORTUNG_BARE_BENCH " " + std::to_string(robots) + " " + std::to_string(seconds);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  Bare bare;
  if (!pipe ||
      std::fscanf(pipe.get(), "%lf %lf %lf", &bare.physics, &bare.withRays, &bare.meanRange) != 3)
    throw std::runtime_error(command + " gave no figures");
  return bare;
}

void compare(Figures& figures, std::size_t robots, double seconds, PluginFactory& factory) {
  const Bare bare = measureBare(robots, seconds);
  Ours alone(robots, false, factory);
  report(figures, "physics", robots, {bare.physics, measure(seconds, [&](int) { alone.step(); })},
         1.0);
  Ours ours(robots, true, factory);
  ours.step();
  const double ourMean = ours.meanRange();
  report(figures, "with lasers", robots,
         {bare.withRays, measure(seconds, [&](int) { ours.step(); })}, 3.0);
  std::printf("%-13s %4zu %12.4f %12.4f            %zu rays\n", "mean range", robots,
              bare.meanRange, ourMean, 180 * robots);
}

/// Who reads what in a match.
enum class Match {
  kUnread,      ///< lasers, odometry and compass, which nobody reads
  kRead,        ///< all readings are read
  kWithCameras  ///< those of omnivision cameras, too
};

/// Ten robots that crowd a ball on the MSL field: contacts all the time.
class Crowd {
 public:
  Crowd(std::uint64_t seed, Match kind, PluginFactory& factory)
      : kind_(kind),
        simulation_(readWorld(ORTUNG_MAPS "/fields/msl.toml"),
                    {.cycle = kCycle, .seed = seed, .sensesWhenRead = kind == Match::kUnread}) {
    RobotConfig config = readRobot(std::filesystem::path(ORTUNG_MAPS "/robots/msl_omni.toml"));
    if (kind != Match::kWithCameras)
      std::erase_if(config.sensors,
                    [](const SensorConfig& one) { return one.plugin == "iconic_omnivision"; });
    for (int i = 0; i < kRobots; ++i) {
      config.name = "robot" + std::to_string(i);
      const double angle = kTurn * i / kRobots;
      simulation_.addRobot(config, factory,
                           {3.0 * std::cos(angle), 3.0 * std::sin(angle), wrapAngle(angle + 3.0)});
    }
  }

  /// Everybody runs to the ball, and backs off for a while now and then.
  void step(int cycle) {
    simulation_.sense();
    const Pose2& ball = simulation_.things()[0].pose;
    for (int i = 0; i < kRobots; ++i) {
      SimRobot& robot = *simulation_.robots()[static_cast<std::size_t>(i)];
      const Pose2& pose = robot.state().pose;
      const double error = wrapAngle(std::atan2(ball.y - pose.y, ball.x - pose.x) - pose.theta);
      const bool backs = (cycle / 200 + i) % 5 == 0;
      robot.drive().setRotationalVelocity(3.0 * error);
      robot.drive().setTranslationalVelocity(backs ? -1.0 : 2.0 * std::cos(error));
      const Twist& is = robot.state().velocity;
      if (std::abs(is.x) + std::abs(is.y) < 0.5) ++slow_;
      if (kind_ != Match::kUnread)
        readings_ += simulation_.readings(static_cast<std::size_t>(i)).size();
    }
    simulation_.move();
  }
  std::size_t readings() const { return readings_; }
  /// Number of cycles and robots, of those that were slow or held.
  std::size_t slow() const { return slow_; }

  static constexpr int kRobots = 10;

 private:
  Match kind_;
  Simulation simulation_;
  std::size_t readings_ = 0;
  std::size_t slow_ = 0;
};

/// Whole matches, since some of their minutes are dearer than others. Of each the fastest of some
/// runs counts.
void match(Figures& figures, const char* what, Match kind, PluginFactory& factory) {
  constexpr std::uint64_t kMatches = 5;
  constexpr int kCycles = 6000;
  double elapsed = 0.0;
  std::size_t readings = 0;
  std::size_t slow = 0;
  for (std::uint64_t seed = 1; seed <= kMatches; ++seed) {
    double best = 1e9;
    for (int round = 0; round < 3; ++round) {
      Crowd crowd(seed, kind, factory);
      const double begin = computingTime();
      for (int cycle = 0; cycle < kCycles; ++cycle) crowd.step(cycle);
      best = std::min(best, computingTime() - begin);
      if (round > 0) continue;
      readings += crowd.readings();
      slow += crowd.slow();
    }
    elapsed += best;
  }
  constexpr double kAll = kMatches * kCycles;
  figures.put(what, "x_real_time", kAll * kCycle / elapsed);
  figures.put(what, "cycle_us", 1e6 * elapsed / kAll);
  std::printf(
      "%-30s %4.0f times real time, %5.1f us a cycle; %zu readings, a robot slow or held in "
      "%.0f %% of all cycles\n",
      what, kAll * kCycle / elapsed, 1e6 * elapsed / kAll, readings,
      100.0 * static_cast<double>(slow) / (Crowd::kRobots * kAll));
}

void run(double seconds) {
  Figures figures;
  PluginFactory factory(PluginFactory::standardFolders());
  std::printf("simulated seconds a second of computing time, cycle 10 ms\n");
  std::printf("%-13s %4s %12s %12s %8s\n", "", "N", "bare Box2D", "ours", "ratio");
  for (const std::size_t robots : {1u, 8u, 32u, 100u}) compare(figures, robots, seconds, factory);
  std::printf("\nMSL matches, 10 robots that crowd a ball, on one core (aim 300 unread)\n");
  match(figures, "lasers, compasses, unread", Match::kUnread, factory);
  match(figures, "... which are read", Match::kRead, factory);
  match(figures, "... and omnivision cameras", Match::kWithCameras, factory);
  figures.write();
}

void runMatch(int cycles) {
  PluginFactory factory(PluginFactory::standardFolders());
  Crowd crowd(1, Match::kUnread, factory);
  for (int cycle = 0; cycle < cycles; ++cycle) crowd.step(cycle);
}

}  // namespace
}  // namespace ortung::bench

int main(int argc, char** argv) {
  try {
    if (argc == 3 && std::string(argv[1]) == "match")
      ortung::bench::runMatch(std::atoi(argv[2]));
    else
      ortung::bench::run(argc > 1 ? std::atof(argv[1]) : 2.0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sim_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}

// Simulated seconds a second of computing time: our simulator beside bare Box2D with its own ray
// cast, in the same run, and a match. sim_bench [SECONDS]: how long each is measured at least.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>

#include "ArenaStarts.hpp"
#include "BareBox2d.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung::bench {
namespace {

constexpr double kCycle = 0.01;   // [s]
constexpr int kCyclesAScan = 10;  // 10 Hz
constexpr int kRounds = 5;        // the fastest counts, since other programs run on the machine

double computingTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

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

/// Simulated seconds a second of computing time, of the fastest round.
template <class Step>
double measure(double seconds, const Step& step) {
  double best = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const double begin = computingTime();
    double elapsed = 0.0;
    int cycles = 0;
    while (elapsed < seconds / kRounds) {
      for (int i = 0; i < kCyclesAScan; ++i) step(cycles++);
      elapsed = computingTime() - begin;
    }
    best = std::max(best, cycles * kCycle / elapsed);
  }
  return best;
}

struct Pair {
  double bare, ours;
};

void print(const char* what, std::size_t robots, const Pair& pair, double aim) {
  std::printf("%-13s %4zu %12.1f %12.1f %8.2f   %s %.1f\n", what, robots, pair.bare, pair.ours,
              pair.ours / pair.bare, pair.ours / pair.bare >= aim ? "reaches" : "MISSES", aim);
}

void compare(std::size_t robots, double seconds, PluginFactory& factory) {
  std::vector<float> ranges;
  {
    BareBox2d bare(robots);
    Ours ours(robots, false, factory);
    print(
        "physics", robots,
        {measure(seconds, [&](int) { bare.step(); }), measure(seconds, [&](int) { ours.step(); })},
        0.8);
  }
  BareBox2d bare(robots);
  bare.cast(ranges);
  double sum = 0.0;
  for (const float range : ranges) sum += static_cast<double>(range);
  const double bareMean = sum / static_cast<double>(ranges.size());
  Ours ours(robots, true, factory);
  ours.step();
  const double ourMean = ours.meanRange();
  print("with lasers", robots,
        {measure(seconds,
                 [&](int cycle) {
                   bare.step();
                   if (cycle % kCyclesAScan == 0) bare.cast(ranges);
                 }),
         measure(seconds, [&](int) { ours.step(); })},
        3.0);
  std::printf("%-13s %4zu %12.4f %12.4f            %zu rays\n", "mean range", robots, bareMean,
              ourMean, ranges.size());
}

/// Ten robots with lasers crowd a ball on the MSL field: contacts all the time.
/// @param withCameras whether the robots have their omnivision cameras, too
void match(double seconds, PluginFactory& factory, bool withCameras) {
  Simulation simulation(readWorld(ORTUNG_MAPS "/fields/msl.toml"), {.cycle = kCycle, .seed = 3});
  RobotConfig config = readRobot(std::filesystem::path(ORTUNG_MAPS "/robots/msl_omni.toml"));
  if (!withCameras) {
    std::erase_if(config.sensors,
                  [](const SensorConfig& one) { return one.plugin == "iconic_omnivision"; });
  }
  for (int i = 0; i < 10; ++i) {
    config.name = "robot" + std::to_string(i);
    const double angle = 0.2 * std::numbers::pi * i;
    simulation.addRobot(config, factory,
                        {3.0 * std::cos(angle), 3.0 * std::sin(angle), wrapAngle(angle + 3.0)});
  }
  std::size_t readings = 0;
  std::size_t contacts = 0;
  std::size_t cycles = 0;
  const double speed = measure(seconds, [&](int) {
    // Everybody runs to the ball, and backs off for a while now and then.
    for (std::size_t i = 0; i < 10; ++i) {
      SimRobot& robot = *simulation.robots()[i];
      const Pose2& pose = robot.state().pose;
      const Pose2& ball = simulation.things()[0].pose;
      const double error = wrapAngle(std::atan2(ball.y - pose.y, ball.x - pose.x) - pose.theta);
      const bool backs = (cycles / 200 + i) % 5 == 0;
      robot.drive().setRotationalVelocity(3.0 * error);
      robot.drive().setTranslationalVelocity(backs ? -1.0 : 2.0 * std::cos(error));
      if (std::abs(robot.state().velocity.x) + std::abs(robot.state().velocity.y) < 0.5) ++contacts;
      readings += simulation.readings(i).size();
    }
    simulation.step();
    ++cycles;
  });
  std::printf(
      "\nMSL match, 10 robots with lasers (180 beams at 10 Hz), odometry, compass%s, and a ball:\n"
      "%.0f times real time on one core%s; %zu cycles, %zu readings, a robot slow or "
      "held in %.0f %% of them\n",
      withCameras ? ", omnivision cameras" : "", speed, withCameras ? "" : " (aim 200)", cycles,
      readings, 10.0 * static_cast<double>(contacts) / static_cast<double>(cycles));
}

void run(double seconds) {
  PluginFactory factory(PluginFactory::standardFolders());
  std::printf("simulated seconds a second of computing time, cycle 10 ms\n");
  std::printf("%-13s %4s %12s %12s %8s\n", "", "N", "bare Box2D", "ours", "ratio");
  for (const std::size_t robots : {1u, 8u, 32u, 100u}) compare(robots, seconds, factory);
  match(seconds, factory, false);
  match(seconds, factory, true);
}

}  // namespace
}  // namespace ortung::bench

int main(int argc, char** argv) {
  ortung::bench::run(argc > 1 ? std::atof(argv[1]) : 2.0);
  return 0;
}

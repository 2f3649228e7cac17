#include "Truth.hpp"

#include <algorithm>

#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/PoseData.hpp"

namespace ortung {
namespace {

const SensorId kRobots{"world", "truth", "robots"};
const SensorId kObjects{"world", "truth", "objects"};
constexpr std::uint32_t kOnTheFloor = 2147483648u;  // height 0, in mm + 2^31
constexpr std::size_t kMostManipulators = 8;        // whose states a word holds
constexpr std::size_t kLastState = 15;

std::uint32_t statesOf(const SimRobot& robot) {
  std::uint32_t word = 0;
  const auto states = robot.manipulatorStates();
  for (std::size_t i = 0; i < std::min(states.size(), kMostManipulators); ++i)
    word |= static_cast<std::uint32_t>(std::min(states[i], kLastState)) << (4 * i);
  return word;
}

}  // namespace

Truth::Truth() : readings_{{0, kRobots, {}}, {0, kObjects, {}}} {}

std::vector<ServedFeature> Truth::features() {
  return {
      {kRobots,
       "for each robot: number, x [mm + 2^31], y [mm + 2^31], heading [1/100 degree], "
       "states of "
       "its manipulators, four bits each, the first one lowest",
       {},
       formats::kWorldRobots},
      {kObjects,
       "for each object of DESCRIBE world: x [mm + 2^31], y [mm + 2^31], z [mm + 2^31], heading "
       "[1/100 degree]",
       {},
       formats::kWorldObjects}};
}

std::span<Message> Truth::look(const Simulation& simulation,
                               const std::map<RobotNumber, RobotId>& numbers) {
  for (Message& reading : readings_) {
    reading.stamp = simulation.now();
    reading.words.clear();
  }
  auto& robots = readings_[0].words;
  for (const auto& robot : simulation.robots()) {
    const auto number = numbers.find(robot->state().number);
    if (number == numbers.end()) continue;
    const auto words = robotWords(number->second, robot->state().pose, statesOf(*robot));
    robots.insert(robots.end(), words.begin(), words.end());
  }
  auto& objects = readings_[1].words;
  for (const Simulation::Thing& thing : simulation.things()) {
    const std::vector<std::uint32_t> pose = PoseData::encode(thing.pose);
    objects.insert(objects.end(), {pose[0], pose[1], kOnTheFloor, headingWord(thing.pose.theta)});
  }
  return readings_;
}

}  // namespace ortung

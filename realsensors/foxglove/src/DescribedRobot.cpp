#include "DescribedRobot.hpp"

#include <cstdio>
#include <map>
#include <stdexcept>

#include "BoardReplies.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung::foxglove {
namespace {

/// A feature of one of the formats, by what the board says of its words: they say all that a
/// message needs. Null for other formats. @throws std::invalid_argument for settings of none
std::unique_ptr<SensorData> featureOf(const SensorId& id, const Pose2& mount,
                                      const std::string& help) {
  double first = 0.0;
  double step = 0.0;
  double most = 0.0;  // [mm]
  ScanData::Config scan;
  if (std::sscanf(
          help.c_str(),
          "[distance mm] of each of %d beams from %lf deg in steps of %lf deg; 0: not valid; "
          "from %lf on",
          &scan.beams, &first, &step, &most) == 4) {
    scan.firstAngle = radians(first);
    scan.angleStep = std::min(radians(step), kTurn / std::max(scan.beams, 1));
    scan.maxRange = most / 1000.0;
    return std::make_unique<ScanData>(id, mount, scan);
  }
  double opening = 0.0;  // [degrees]
  if (std::sscanf(help.c_str(),
                  "[distance mm]; 0: not valid; from %lf on: nothing seen, within %lf deg", &most,
                  &opening) == 2) {
    ConeData::Config cone;
    cone.openingAngle = radians(opening);
    cone.maxRange = most / 1000.0;
    return std::make_unique<ConeData>(id, mount, cone);
  }
  if (help == OdometryData(id).wordsHelp()) return std::make_unique<OdometryData>(id);
  if (help == PoseData(id).wordsHelp()) return std::make_unique<PoseData>(id);
  if (help == PoseFixData(id, {}).wordsHelp())
    return std::make_unique<PoseFixData>(id, PoseFixData::Config{});
  if (help.starts_with(ImageData(id, {}).wordsHelp()))
    return std::make_unique<ImageData>(id, mount);
  return nullptr;
}

}  // namespace

std::unique_ptr<DescribedRobot> describedRobot(const std::vector<std::string>& lines,
                                               const std::string& name) {
  auto robot = std::make_unique<DescribedRobot>();
  std::map<std::string, Pose2> mounts;
  for (const std::string& line : lines) {
    const BoardReply parsed = parseBoardLine(line);
    if (parsed.words.size() < 2 || parsed.words[0] != "mount") continue;
    mounts[parsed.words[1]] = {parsed.real("x_m").value_or(0.0), parsed.real("y_m").value_or(0.0),
                               parsed.real("theta_rad").value_or(0.0)};
  }
  std::vector<SensorId> others;
  for (const std::string& line : lines) {
    const std::size_t blank = line.find(' ');
    if (line.substr(0, blank).find('/') == line.npos) continue;  // no feature
    try {
      const SensorId id = parseSensorId(line.substr(0, blank));
      robot->hasTruth |= id.type == "groundTruth";
      auto data =
          featureOf(id, mounts[toText(id)], blank == line.npos ? "" : line.substr(blank + 1));
      data ? static_cast<void>(robot->container.add(std::move(data))) : others.push_back(id);
    } catch (const std::invalid_argument&) {
      continue;  // a feature of a later board
    }
  }
  robot->topics = std::make_unique<ros2::RobotTopics>(robot->container,
                                                      ros2::RobotTopics::Options{.robot = name});
  for (const SensorId& id : others)
    if (id.model != "mcl" || id.feature != "samples") robot->topics->addWords(id);
  return robot;
}

}  // namespace ortung::foxglove

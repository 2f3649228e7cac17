#include "MotionLogs.hpp"

#include <fmt/format.h>

#include <functional>
#include <stdexcept>

#include "Interrupt.hpp"
#include "SourceArguments.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::app {
namespace {

/// Returns the first feature of the robot that is odometry, which MCL uses, too.
const OdometryData& odometryOf(const Robot& robot, const std::filesystem::path& robotFile) {
  for (const auto& data : robot.container.all()) {
    if (const auto* odometry = dynamic_cast<const OdometryData*>(data.get())) return *odometry;
  }
  throw std::runtime_error(robotFile.string() +
                           ": has no odometry, expected a [[sensor]] with plugin = \"odometry\"");
}

using Listener = std::function<void(Timestamp, const OdometryData::Reading&)>;

/// Reads a whole source. @throws std::runtime_error if it has no odometry or no truth
void readAll(const std::string& text, const std::filesystem::path& robotFile, Progress& progress,
             const Listener& onOdometry,
             const std::function<void(Timestamp, const Pose2&)>& onTruth) {
  const std::string name = text.find(':') == std::string::npos ? "record:" + text : text;
  const std::unique_ptr<Robot> robot = openRobot(robotFile);
  const OdometryData& odometry = odometryOf(*robot, robotFile);
  const std::unique_ptr<Source> source = openSourceArgument(name, robotFile, robot->factory);
  Feeder feeder(name, *source, robot->container);
  std::uint64_t sequence = 0;
  bool hasTruth = false;
  while (feeder.next()) {
    checkInterrupt();
    progress.update(feeder.progress());
    if (feeder.truth()) onTruth(feeder.stamp(), *feeder.truth());
    hasTruth = hasTruth || feeder.truth();
    if (odometry.sequence() != sequence) onOdometry(odometry.stamp(), odometry.reading());
    sequence = odometry.sequence();
  }
  warnOf(*source);
  if (sequence == 0) {
    throw std::runtime_error(fmt::format(
        "{}: has no reading of {}, expected odometry to learn from", name, toText(odometry.id())));
  }
  if (!hasTruth) {
    throw std::runtime_error(fmt::format(
        "{}: has no ground truth to learn from, expected a feature of type groundTruth", name));
  }
}

}  // namespace

MotionLog readMotionLog(const std::string& text, const std::filesystem::path& robotFile,
                        double from, double to, MotionModel& model, Progress& progress) {
  struct Reading {
    Timestamp stamp;
    Pose2 pose;
    double v;
    double w;
    double sideways;
  };
  std::vector<Reading> odometry;
  std::vector<std::pair<Timestamp, Pose2>> truth;
  readAll(
      text, robotFile, progress,
      [&](Timestamp stamp, const OdometryData::Reading& r) {
        model.follow(stamp, {r.pose, r.translationalVelocity, r.rotationalVelocity, r.motionData,
                             r.lateralVelocity});
        odometry.push_back({stamp, model.odometryAt(stamp).value_or(r.pose),
                            r.translationalVelocity, r.rotationalVelocity, r.lateralVelocity});
      },
      [&](Timestamp stamp, const Pose2& pose) { truth.emplace_back(stamp, pose); });
  const Timestamp first = odometry.front().stamp;
  const double span = toSeconds(odometry.back().stamp - first);
  const Timestamp begin = first + fromSeconds(from * span);
  const Timestamp end = first + fromSeconds(to * span);
  MotionLog log;
  for (const Reading& r : odometry) {
    if (r.stamp >= begin && r.stamp <= end) log.odometry.add(r.stamp, r.pose, r.v, r.w, r.sideways);
  }
  for (const auto& point : truth) {
    if (point.first >= begin && point.first <= end) log.truth.push_back(point);
  }
  return log;
}

CommandLog readCommandLog(const std::string& text, const std::filesystem::path& robotFile,
                          const std::string& from, bool& fromVelocities, Progress& progress) {
  CommandLog log;
  bool first = true;
  readAll(
      text, robotFile, progress,
      [&](Timestamp stamp, const OdometryData::Reading& r) {
        const std::size_t count = r.motionData.size();
        if (first) fromVelocities = from == "velocities" || (from == "auto" && count < 2);
        first = false;
        if (fromVelocities) {
          log.commands.emplace_back(stamp,
                                    Velocities{r.translationalVelocity, r.rotationalVelocity});
        } else if (count >= 2) {
          log.commands.emplace_back(stamp,
                                    Velocities{words::toSignedMetres(r.motionData[count - 2]),
                                               words::toRate(r.motionData[count - 1])});
        }
      },
      [&](Timestamp stamp, const Pose2& pose) { log.truth.add(stamp, pose, 0.0, 0.0); });
  if (log.commands.empty()) {
    throw std::runtime_error(text +
                             ": odometry has no motion data, expected commanded velocities there; "
                             "use --commands-from velocities");
  }
  return log;
}

}  // namespace ortung::app

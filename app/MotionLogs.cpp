#include "MotionLogs.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "Interrupt.hpp"
#include "Localization.hpp"
#include "Sources.hpp"
#include "ortung/container/Formats.hpp"

namespace ortung::app {
namespace {

/// The first feature of the robot that is odometry, as MCL takes it.
const OdometryData& odometryOf(const Robot& robot, const std::filesystem::path& robotFile) {
  for (const auto& data : robot.container.all()) {
    if (const auto* odometry = dynamic_cast<const OdometryData*>(data.get())) return *odometry;
  }
  throw std::runtime_error(robotFile.string() +
                           ": has no odometry, expected a [[sensor]] with plugin = \"odometry\"");
}

/// Only what lies within a part of the time.
MotionLog partOf(const MotionLog& all,
                 const std::vector<std::pair<Timestamp, OdometryView>>& odometry, double from,
                 double to) {
  if (from <= 0.0 && to >= 1.0) return all;
  const double span = toSeconds(all.odometry.last() - all.odometry.first());
  const Timestamp begin = all.odometry.first() + fromSeconds(from * span);
  const Timestamp end = all.odometry.first() + fromSeconds(to * span);
  MotionLog part;
  for (const auto& [stamp, view] : odometry) {
    if (stamp < begin || stamp > end) continue;
    part.odometry.add(stamp, view.pose, view.translationalVelocity, view.rotationalVelocity);
  }
  for (const auto& point : all.truth) {
    if (point.first >= begin && point.first <= end) part.truth.push_back(point);
  }
  return part;
}

}  // namespace

MotionLog readMotionLog(const std::string& text, const std::filesystem::path& robotFile,
                        double from, double to, Progress& progress) {
  const std::string name = text.find(':') == std::string::npos ? "record:" + text : text;
  const std::unique_ptr<Robot> robot = openRobot(robotFile);
  const OdometryData& odometry = odometryOf(*robot, robotFile);
  const std::unique_ptr<Source> source = openSource(name, robotFile, robot->factory);
  Feeder feeder(name, *source, robot->container);
  MotionLog log;
  std::vector<std::pair<Timestamp, OdometryView>> readings;
  std::uint64_t sequence = 0;
  while (feeder.next()) {
    checkInterrupt();
    progress.update(feeder.progress());
    if (feeder.truth()) log.truth.emplace_back(feeder.stamp(), *feeder.truth());
    if (odometry.sequence() == sequence) continue;
    sequence = odometry.sequence();
    const OdometryData::Reading& r = odometry.reading();
    log.odometry.add(odometry.stamp(), r.pose, r.translationalVelocity, r.rotationalVelocity);
    readings.emplace_back(odometry.stamp(),
                          OdometryView{r.pose, r.translationalVelocity, r.rotationalVelocity, {}});
  }
  if (log.odometry.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: has no reading of {}, expected odometry to learn from", name, toText(odometry.id())));
  }
  if (log.truth.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: has no ground truth to learn from, expected a feature of type groundTruth", name));
  }
  return partOf(log, readings, from, to);
}

}  // namespace ortung::app

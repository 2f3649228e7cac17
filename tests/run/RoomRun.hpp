#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "FakeRoom.hpp"
#include "Files.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::test {

/// A robot file with scanner and odometry, its tables for an empty room, and 4 s of a drive in it
/// as moments and as a record.
class RoomRun : public testing::Test {
 protected:
  RoomRun() {
    writeBytes(robotFile, R"([robot]
radius_m = 0.2
[[sensor]]
plugin = "odometry"
[[sensor]]
plugin = "lrf"
beams = 31
fov_deg = 180
max_range_m = 8
[mcl]
particles = 1000
)");
    learn("room-1");
    for (int i = 0; i <= 40; ++i) drive(i);
    record("room-1");
  }

  void learn(const std::string& world) const {
    const auto robot = openRobot(robotFile);
    TableInfo info{"room", world, "robot", kPi / 60, room.region(0.1, 0.2), {}};
    auto& scanner = dynamic_cast<ScanData&>(*robot->container.find({.type = "LRF"}));
    learnEverywhere(scanner, info.region, info.headingStep,
                    [&](const Pose2& s) { return scanWords(room, s, scanner.config()); });
    writeTables(tables, robot->container, info);
  }

  void record(const std::string& world) const {
    RecordWriter writer(recordFile, world);
    for (const auto& moment : moments)
      for (const Message& message : moment) writer.write(message);
    writer.commit();
  }

  LocalizationConfig config() const {
    return {.robot = robotFile, .tables = tables, .start = {LocalizationStart::Kind::kPose, start}};
  }
  LocalizationConfig fromRecord() const {
    LocalizationConfig config = this->config();
    config.source = "record:" + recordFile.string();
    return config;
  }

  const TemporaryFolder folder;
  const std::filesystem::path robotFile = folder / "robot.toml";
  const std::filesystem::path tables = folder / "room.ortung";
  const std::filesystem::path recordFile = folder / "run.rec";
  const Room room{4, 3};
  const Pose2 start{0.9, 0.0, kPi / 2};
  Pose2 truth = start;
  std::vector<std::vector<Message>> moments;

 private:
  /// A tenth of a second of a circle of 0.9 m; odometry is exact.
  void drive(int i) {
    constexpr double kTurn = 0.35 / 10;
    if (i > 0) truth = truth * Pose2{0.9 * kTurn, 0, kTurn};
    const ScanData::Config scan{
        .beams = 31, .firstAngle = -kPi / 2, .angleStep = kPi / 30, .maxRange = 8.0};
    const Timestamp now = 100'000 * i;
    moments.push_back({{now,
                        {"odometry", "odometry", "pose"},
                        OdometryData::encode({inverse(start) * truth, 0, 0, {}})},
                       {now, {"LMS200", "LRF", "180DegreeScan"}, scanWords(room, truth, scan)},
                       {now, {"reference", "groundTruth", "pose"}, PoseData::encode(truth)}});
  }
};

}  // namespace ortung::test

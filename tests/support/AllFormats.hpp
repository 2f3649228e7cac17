#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "FakeRoom.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"

/// Features of all formats in the room of FakeRoom.hpp, ready to weigh.
namespace ortung::test {

/// Where the first post stands [m].
inline constexpr double kPostX = 1.1;
inline constexpr double kPostY = -0.7;

inline double distanceToPost(const Pose2& sensor) {
  return std::hypot(kPostX - sensor.x, kPostY - sensor.y);
}

/// One of each format that is a table, learned with a mount, and a reading taken at @p sensor.
inline std::vector<std::unique_ptr<SensorData>> allFormats(const Room& room,
                                                           const FieldRegion& region,
                                                           const Pose2& mount,
                                                           const Pose2& sensor) {
  using Words = std::vector<std::uint32_t>;
  std::vector<std::unique_ptr<SensorData>> all;
  const auto nextId = [&] { return SensorId{"M", "T", "F" + std::to_string(all.size())}; };
  const auto add = [&](auto data, const std::function<Words(const Pose2&)>& words) {
    learnEverywhere(*data, region, kPi / 90, words);
    data->setData(1, words(sensor));
    all.push_back(std::move(data));
  };
  const std::vector<Point> posts = {{1, kPostX, kPostY}, {2, -2.0, 1.5}};
  add(std::make_unique<ScalarData>(nextId(), mount, ScalarData::Config{}),
      [](const Pose2& s) { return ScalarData::encode(distanceToPost(s)); });
  add(std::make_unique<BearingData>(nextId(), mount, BearingData::Config{}),
      [](const Pose2& s) { return BearingData::encode(bearingTo(s, kPostX, kPostY)); });
  add(std::make_unique<LandmarksData>(
          nextId(), mount,
          LandmarksData::Config{.identities = {1, 2}, .maxRange = 3.0, .range = {}}),
      [posts](const Pose2& s) { return landmarkWords(posts, s, 3.0); });
  add(std::make_unique<ConeData>(nextId(), mount, ConeData::Config{}),
      [&](const Pose2& s) { return Words{ConeData::encode(room.range(s.x, s.y, s.theta), 3.0)}; });
  for (const auto perception : {ScanData::Perception::kRays, ScanData::Perception::kEndPoints}) {
    const ScanData::Config config{
        .beams = 90, .firstAngle = -kPi / 2, .angleStep = kPi / 90, .perception = perception};
    add(std::make_unique<ScanData>(nextId(), mount, config),
        [&room, config](const Pose2& s) { return scanWords(room, s, config); });
  }
  return all;
}

/// Poses inside and outside whose sensors are not so near a cell's edge that float and double
/// differ.
inline std::vector<Pose2> somePoses(const FieldGrid& grid, const Pose2& mount, std::size_t n) {
  Random random(5);
  std::vector<Pose2> poses;
  const auto nearEdge = [&](double v, double origin) {
    const double place = (v - origin) / grid.cell;
    return std::abs(place - std::nearbyint(place)) < 1e-3;
  };
  while (poses.size() < n) {
    const Pose2 pose{static_cast<float>(random.uniform(-5, 5)),
                     static_cast<float>(random.uniform(-3.5, 3.5)),
                     static_cast<float>(random.uniform(-9, 9))};
    const Pose2 sensor = pose * mount;
    if (!nearEdge(sensor.x, grid.originX) && !nearEdge(sensor.y, grid.originY))
      poses.push_back(pose);
  }
  return poses;
}

}  // namespace ortung::test

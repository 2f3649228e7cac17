#include "FloorSeeker.hpp"

#include <iostream>
#include <stdexcept>
#include <utility>

namespace ortung::ros2 {
namespace {

const Building& buildingOf(const Localization& localization) {
  return localization.robot().tables.region.building;
}

/// Returns the heaviest place that the belief has on a floor; nothing: none.
std::optional<PoseEstimate> placeOn(const std::string& floor, const Localization& localization) {
  const Building& building = buildingOf(localization);
  const auto index = building.find(floor);
  for (const PoseEstimate& place : localization.mcl().places())
    if (index == building.floorAt(place.pose.x)) return place;
  return std::nullopt;
}

/// Whether nothing is left to be decided between this floor and others.
bool isSettledOn(const std::string& floor, const Localization& localization) {
  if (!localization.mcl().belief()) return false;
  const Building& building = buildingOf(localization);
  const auto index = building.find(floor);
  return index && localization.mcl().floorShares()[*index] > LiveFloors::kNearlyAll;
}

void sayThereIsNoRoom(const std::string& floor) {
  std::cerr << "ortung-ros2: floor " << floor << " has no room where the robot is" << '\n';
}

}  // namespace

void FloorSeeker::goTo(const std::string& floor, Localization& localization,
                       const std::optional<Message>& odometry, const LocalizationStart& start) {
  const Building& building = buildingOf(localization);
  if (!floors_.goTo(floor)) {
    std::cerr << "ortung-ros2: there is no floor " << floor << " in this building" << '\n';
    return;
  }
  sought_.clear();
  if (isSettledOn(floor, localization)) return;
  const auto here = odometry ? localization.estimate(odometry->stamp) : std::nullopt;
  const bool isLost = here && here->status == TrackStatus::kLost;
  try {
    // Who is lost between places knows these; otherwise they are worth nothing.
    if (here && (!isLost || here->reason == TrackReason::kSeveralPlaces))
      if (const auto place = placeOn(floor, localization))
        return localization.setPose(place->pose, place->covariance);
    if (here && !isLost)
      return localization.setPose(*floors_.carried(here->pose, building, floor), here->covariance);
    if (!odometry && start.kind == LocalizationStart::Kind::kPose) {
      LocalizationStart there = start;
      there.pose = *floors_.carried(start.pose, building, floor);
      return localization.start(there);
    }
  } catch (const std::invalid_argument&) {
    sayThereIsNoRoom(floor);
  }
  sought_ = floor;
  if (localization.mcl().belief()) localization.relocalize();  // else a search is going on
}

void FloorSeeker::onEstimate(Localization& localization) {
  if (sought_.empty()) return;
  const PoseEstimate here = localization.mcl().estimate();
  std::optional<PoseEstimate> place = placeOn(sought_, localization);
  if (!place && here.status == TrackStatus::kLost) return;
  const std::string floor = std::exchange(sought_, "");
  if (isSettledOn(floor, localization)) return;
  if (!place) {
    const auto carried = floors_.carried(here.pose, buildingOf(localization), floor);
    if (!carried) return;
    place = here;
    place->pose = *carried;
  }
  try {
    localization.setPose(place->pose, place->covariance);
  } catch (const std::invalid_argument&) {
    sayThereIsNoRoom(floor);
  }
}

}  // namespace ortung::ros2

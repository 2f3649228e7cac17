#include "BuildingJson.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ortung {
namespace {

using nlohmann::json;

constexpr std::size_t kMost = 1000;  // floors, lifts, and stops of a lift

std::vector<json> listIn(const json& object, const char* key) {
  auto list = object.at(key).get<std::vector<json>>();
  if (list.size() > kMost)
    throw std::invalid_argument(std::string(key) + " are more than " + std::to_string(kMost));
  return list;
}

}  // namespace

json toJson(const Building& building) {
  json floors = json::array();
  for (const Floor& floor : building.floors)
    floors.push_back(
        {{"name", floor.name}, {"shift_m", floor.shift}, {"x_m", {floor.xLow, floor.xHigh}}});
  json lifts = json::array();
  for (const Lift& lift : building.lifts) {
    json stops = json::array();
    for (const LiftStop& stop : lift.stops)
      stops.push_back(
          {{"floor", stop.floor}, {"pose", {stop.pose.x, stop.pose.y, stop.pose.theta}}});
    lifts.push_back({{"name", lift.name}, {"radius_m", lift.radius}, {"stops", stops}});
  }
  return {{"floors", floors}, {"lifts", lifts}};
}

Building buildingOf(const json& object) {
  Building building;
  for (const json& floor : listIn(object, "floors")) {
    const json& x = floor.at("x_m");
    building.floors.push_back({floor.at("name").get<std::string>(),
                               floor.at("shift_m").get<double>(), x.at(0).get<double>(),
                               x.at(1).get<double>()});
  }
  for (const json& one : listIn(object, "lifts")) {
    Lift lift{one.at("name").get<std::string>(), one.at("radius_m").get<double>(), {}};
    for (const json& stop : listIn(one, "stops")) {
      const json& pose = stop.at("pose");
      lift.stops.push_back(
          {stop.at("floor").get<std::size_t>(),
           {pose.at(0).get<double>(), pose.at(1).get<double>(), pose.at(2).get<double>()}});
    }
    building.lifts.push_back(std::move(lift));
  }
  building.check();
  return building;
}

}  // namespace ortung

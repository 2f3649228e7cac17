#include "ortung/refbox/WorldState.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

namespace ortung::refbox {
namespace {

using nlohmann::json;

bool areFinite(std::initializer_list<double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
}

json toJson(const Pose2& pose) { return json::array({pose.x, pose.y, pose.theta}); }
json toJson(const Twist& twist) { return json::array({twist.x, twist.y, twist.theta}); }
json toJson(const WorldState::Point& point) { return json::array({point.x, point.y, point.z}); }

}  // namespace

std::string toJson(const WorldState& state) {
  json robots = json::array();
  for (const auto& r : state.robots) {
    if (!isFinite(r.pose) || !isFinite(r.targetPose) ||
        !areFinite({r.velocity.x, r.velocity.y, r.velocity.theta, r.batteryLevel}))
      continue;
    robots.push_back({{"id", r.id},
                      {"pose", toJson(r.pose)},
                      {"targetPose", toJson(r.targetPose)},
                      {"velocity", toJson(r.velocity)},
                      {"intention", r.intention},
                      {"batteryLevel", r.batteryLevel},
                      {"ballEngaged", r.ballEngaged}});
  }
  json balls = json::array();
  for (const auto& b : state.balls) {
    if (!areFinite({b.position.x, b.position.y, b.position.z, b.velocity.x, b.velocity.y,
                    b.velocity.z, b.confidence}))
      continue;
    balls.push_back({{"position", toJson(b.position)},
                     {"velocity", toJson(b.velocity)},
                     {"confidence", b.confidence}});
  }
  json obstacles = json::array();
  for (const auto& o : state.obstacles) {
    if (!areFinite({o.x, o.y, o.vx, o.vy, o.radius, o.confidence})) continue;
    obstacles.push_back({{"position", json::array({o.x, o.y})},
                         {"velocity", json::array({o.vx, o.vy})},
                         {"radius", o.radius},
                         {"confidence", o.confidence}});
  }
  constexpr double kOldest = 1e6;  // [s]
  const double age = std::isfinite(state.age) ? std::clamp(state.age, 0.0, kOldest) : kOldest;
  const json message = {{"type", "worldstate"},
                        {"teamName", state.teamName},
                        {"intention", state.intention},
                        {"robots", std::move(robots)},
                        {"balls", std::move(balls)},
                        {"obstacles", std::move(obstacles)},
                        {"ageMs", std::lround(age * 1000.0)}};
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace ortung::refbox

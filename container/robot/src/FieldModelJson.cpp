#include "FieldModelJson.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ortung {
namespace {

using nlohmann::json;

constexpr std::size_t kMost = 100'000;  // most objects of each kind
constexpr double kFarthest = 1e7;       // [m], [rad]

/// Returns the member @p key, a list of lists.
std::vector<json> entries(const json& object, const char* key) {
  auto list = object.at(key).get<std::vector<json>>();
  if (list.size() > kMost) throw std::invalid_argument(std::string(key) + " are more than 100000");
  return list;
}

/// Returns entry @p at of a list as a number that is in range.
double number(const json& list, std::size_t at) {
  const auto value = list.at(at).get<double>();
  if (!(std::abs(value) <= kFarthest)) throw std::invalid_argument("a number is out of range");
  return value;
}

json listOf(const FieldLine& l) {
  if (l.shape == FieldLine::Shape::kStraight)
    return {"straight", l.x0, l.y0, l.x1, l.y1, l.width, l.colour};
  return {"arc", l.x, l.y, l.radiusX, l.radiusY, l.angle, l.from, l.to, l.width, l.colour};
}

FieldLine lineOf(const json& l) {
  FieldLine line;
  if (l.at(0).get<std::string>() == "straight") {
    line.x0 = number(l, 1);
    line.y0 = number(l, 2);
    line.x1 = number(l, 3);
    line.y1 = number(l, 4);
    line.width = number(l, 5);
    line.colour = l.at(6).get<std::string>();
    return line;
  }
  line.shape = FieldLine::Shape::kArc;
  line.x = number(l, 1);
  line.y = number(l, 2);
  line.radiusX = number(l, 3);
  line.radiusY = number(l, 4);
  line.angle = number(l, 5);
  line.from = number(l, 6);
  line.to = number(l, 7);
  line.width = number(l, 8);
  line.colour = l.at(9).get<std::string>();
  return line;
}

}  // namespace

json toJson(const FieldModel& field) {
  json out{{"lines", json::array()},
           {"walls", json::array()},
           {"goals", json::array()},
           {"landmarks", json::array()}};
  for (const FieldLine& line : field.lines) out["lines"].push_back(listOf(line));
  for (const FieldWall& w : field.walls)
    out["walls"].push_back({w.x0, w.y0, w.x1, w.y1, w.zLow, w.zHigh, w.ofGoal});
  for (const FieldGoal& g : field.goals)
    out["goals"].push_back(
        {g.name, g.colour, g.pose.x, g.pose.y, g.pose.theta, g.halfX, g.halfY, g.zHigh});
  for (const Landmark& l : field.landmarks)
    out["landmarks"].push_back({l.identity, l.kind, l.x, l.y, l.z});
  return out;
}

FieldModel fieldModelOf(const json& from) {
  FieldModel field;
  for (const json& line : entries(from, "lines")) field.lines.push_back(lineOf(line));
  for (const json& w : entries(from, "walls"))
    field.walls.push_back({number(w, 0), number(w, 1), number(w, 2), number(w, 3), number(w, 4),
                           number(w, 5), w.at(6).get<bool>()});
  for (const json& g : entries(from, "goals"))
    field.goals.push_back({g.at(0).get<std::string>(),
                           g.at(1).get<std::string>(),
                           {number(g, 2), number(g, 3), number(g, 4)},
                           number(g, 5),
                           number(g, 6),
                           number(g, 7)});
  for (const json& l : entries(from, "landmarks"))
    field.landmarks.push_back({l.at(0).get<std::uint32_t>(), l.at(1).get<std::string>(),
                               number(l, 2), number(l, 3), number(l, 4)});
  return field;
}

}  // namespace ortung

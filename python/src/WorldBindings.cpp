// Worlds: what they consist of, and what rays meet in them.
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "Worlds.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

py::array wallsOf(const SharedWorld& self) {
  const std::vector<FieldWall> walls = fieldModelOf(*self.world).walls;
  return tableOf(static_cast<py::ssize_t>(walls.size()), 6, [&](py::ssize_t i) {
    const FieldWall& one = walls[static_cast<std::size_t>(i)];
    return std::array{one.x0, one.y0, one.x1, one.y1, one.zLow, one.zHigh};
  });
}

py::list landmarksOf(const SharedWorld& self) {
  py::list all;
  for (const Landmark& one : self.world->landmarks()) {
    py::dict mark;
    mark["kind"] = one.kind;
    mark["identity"] = one.identity;
    mark["position"] = py::make_tuple(one.x, one.y, one.z);
    all.append(mark);
  }
  return all;
}

py::array outline(const std::vector<FloorPoint>& points) {
  return tableOf(static_cast<py::ssize_t>(points.size()), 2, [&](py::ssize_t i) {
    const FloorPoint& one = points[static_cast<std::size_t>(i)];
    return std::array{one.x, one.y};
  });
}

py::list objectsOf(const SharedWorld& self) {
  py::list all;
  for (const WorldObject& one : self.world->objects()) {
    py::list outlines;
    for (const WorldPiece& piece : one.pieces) outlines.append(outline(outlineOf(one, piece)));
    py::dict object;
    object["kind"] = one.kind;
    object["name"] = one.name;
    object["colour"] = one.colour;
    object["pose"] = tupleOf(one.pose);
    object["heights"] = py::make_tuple(one.zLow, one.zHigh);
    object["outlines"] = outlines;
    all.append(object);
  }
  return all;
}

/// Points along the middle of a painted line.
std::vector<FloorPoint> pointsOf(const FieldLine& line) {
  if (line.shape == FieldLine::Shape::kStraight) return {{line.x0, line.y0}, {line.x1, line.y1}};
  constexpr int kSteps = 48;
  std::vector<FloorPoint> points;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = line.from + (line.to - line.from) * i / kSteps;
    const FloorPoint own{line.radiusX * std::cos(t), line.radiusY * std::sin(t)};
    points.push_back({line.x + own.x * std::cos(line.angle) - own.y * std::sin(line.angle),
                      line.y + own.x * std::sin(line.angle) + own.y * std::cos(line.angle)});
  }
  return points;
}

py::list linesOf(const SharedWorld& self) {
  py::list all;
  for (const FieldLine& one : self.world->lines()) {
    py::dict line;
    line["points"] = outline(pointsOf(one));
    line["width"] = one.width;
    line["colour"] = one.colour;
    all.append(line);
  }
  return all;
}

FieldRegion regionOf(const SharedWorld& self, double cell,
                     const std::optional<std::filesystem::path>& robot, const std::string& area) {
  const py::gil_scoped_release others;
  const RobotSize size = robot ? sizeOf(readRobot(*robot)) : RobotSize{};
  return learnAreaOf(*self.world, cell, size, area).region;
}

void needFinite(const Numbers& numbers, const char* what) {
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers.data()[i]))
      throw py::value_error(std::string(what) + " " + std::to_string(i) + " is " +
                            std::to_string(numbers.data()[i]) + ", expected a finite number");
}

void checkRays(double maxRange, double height) {
  if (!(maxRange > 0.0) || !std::isfinite(maxRange))
    throw py::value_error("max_range must be positive [m]");
  if (!std::isfinite(height)) throw py::value_error("height must be a finite number [m]");
}

/// Ranges of rays from poses, each along its heading.
py::array cast(const SharedWorld& self, const py::object& given, double maxRange, double height) {
  const Numbers poses = realNumbers<double>(given, "poses");
  if (poses.ndim() != 2 || poses.shape(1) != 3)
    throw py::value_error("poses must have the shape (N, 3): x, y, heading");
  needFinite(poses, "poses: number");
  checkRays(maxRange, height);
  py::array_t<float> ranges(poses.shape(0));
  const auto n = static_cast<std::size_t>(poses.shape(0));
  const double* pose = poses.data();
  float* range = ranges.mutable_data();
  {
    const py::gil_scoped_release others;
    for (std::size_t i = 0; i < n; ++i, pose += 3)
      self.world->castFan({pose[0], pose[1], height, pose[2], 0.0, 0.0, maxRange}, 0,
                          {range + i, 1});
  }
  return ranges;
}

/// Ranges of a scanner at poses.
py::array scan(const SharedWorld& self, const py::object& given, int beams, double fov,
               double maxRange, double height) {
  const Numbers poses = realNumbers<double>(given, "poses");
  if (poses.ndim() != 2 || poses.shape(1) != 3)
    throw py::value_error("poses must have the shape (N, 3): x, y, heading");
  needFinite(poses, "poses: number");
  checkRays(maxRange, height);
  if (beams < 1 || beams > 100'000) throw py::value_error("beams must be in 1 to 100000");
  if (!(fov >= 0.0 && fov <= 2.0 * M_PI)) throw py::value_error("fov must be in [0, 2 pi] rad");
  const double step = beams > 1 ? fov / (beams - 1) : 0.0;
  py::array_t<float> ranges({poses.shape(0), static_cast<py::ssize_t>(beams)});
  const auto n = static_cast<std::size_t>(poses.shape(0));
  const auto width = static_cast<std::size_t>(beams);
  const double* pose = poses.data();
  float* range = ranges.mutable_data();
  {
    const py::gil_scoped_release others;
    for (std::size_t i = 0; i < n; ++i, pose += 3)
      self.world->castFan({pose[0], pose[1], height, pose[2] - 0.5 * fov, step, 0.0, maxRange}, 0,
                          {range + i * width, width});
  }
  return ranges;
}

bool isFree(const SharedWorld& self, double x, double y, double radius, double height) {
  if (!(radius >= 0.0) || !(height > 0.0))
    throw py::value_error("radius must be at least 0, height above 0 [m]");
  return self.world->isFree(x, y, {radius, height});
}

std::string reprOf(const SharedWorld& self) {
  const Box2 bounds = self.world->solids().bounds;
  char text[120];
  std::snprintf(text, sizeof text, "', %g m x %g m, fingerprint='", bounds.xHigh - bounds.xLow,
                bounds.yHigh - bounds.yLow);
  return "World('" + self.world->name() + text + self.world->fingerprint() + "')";
}

using PyWorld = py::class_<SharedWorld>;

void bindRays(PyWorld& world) {
  world
      .def("cast", &cast, py::arg("poses"), py::arg("max_range") = 20.0, py::arg("height") = 0.3,
           "Ranges [m] of rays from poses (N, 3) x, y [m], heading [rad], each along its heading, "
           "at a height above the floor [m], (N,); max_range where they meet nothing.")
      .def("scan", &scan, py::arg("poses"), py::arg("beams") = 181, py::arg("fov") = M_PI,
           py::arg("max_range") = 8.0, py::arg("height") = 0.3,
           "Ranges [m] of a scanner at poses (N, 3), (N, beams): its beams are spread evenly over "
           "`fov` [rad], counter-clockwise, the middle one along the heading. There is no noise.")
      .def("is_free", &isFree, py::arg("x"), py::arg("y"), py::arg("radius") = 0.0,
           py::arg("height") = 0.5,
           "Whether a robot of this radius and height [m] has room with its middle at x, y [m].");
}

}  // namespace

SharedWorld worldOf(const py::object& world) {
  if (py::isinstance<SharedWorld>(world)) return py::cast<SharedWorld>(world);
  const auto file = py::cast<std::filesystem::path>(world);
  const py::gil_scoped_release others;
  return {file, readWorld(file)};
}

void bindWorlds(py::module_& module) {
  PyWorld world(module, "World",
                "A world as its file describes it, without robots: what can be seen in it, and "
                "where there is room. Nothing in it moves.");
  world
      .def(py::init([](const std::filesystem::path& file) {
             const py::gil_scoped_release others;
             return SharedWorld{file, readWorld(file)};
           }),
           py::arg("file"), "Reads a world file (TOML), or a map of map_server (Nav2), map.yaml.")
      .def_property_readonly(
          "file", [](const SharedWorld& self) { return self.file; }, "The file it was read from.")
      .def_property_readonly(
          "name", [](const SharedWorld& self) { return self.world->name(); }, "Its name.")
      .def_property_readonly(
          "fingerprint", [](const SharedWorld& self) { return self.world->fingerprint(); },
          "A digest of all that sensors can learn of it, 16 hexadecimal digits.")
      .def_property_readonly(
          "extent",
          [](const SharedWorld& self) {
            const Box2 box = self.world->solids().bounds;
            return py::make_tuple(box.xLow, box.xHigh, box.yLow, box.yHigh);
          },
          "x, x, y, y of its bounds [m].")
      .def_property_readonly("walls", &wallsOf,
                             "Straight surfaces, the longest first, (N, 6): x, y of both ends, and "
                             "the heights of the lower and upper edge [m].")
      .def_property_readonly("landmarks", &landmarksOf,
                             "What has an identity: kind, identity, position (x, y, z) [m].")
      .def_property_readonly(
          "objects", &objectsOf,
          "Bodies: kind, name, colour, pose (x, y, heading), heights (low, high) "
          "and the outlines of their parts, (n, 2) each [m].")
      .def_property_readonly("lines", &linesOf,
                             "Lines painted on the floor: points of their middle (n, 2), width [m] "
                             "and colour.")
      .def("region", &regionOf, py::arg("cell") = 0.1, py::arg("robot") = py::none(),
           py::arg("area") = "auto",
           "The cells [m] that a robot of a file learns, see learn(); without one, those of a "
           "point.")
      .def("__repr__", &reprOf);
  bindRays(world);
}

}  // namespace ortung::python

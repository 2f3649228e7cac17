// Robots, tables and records.
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "Bindings.hpp"
#include "Robots.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Nearest.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung::python {
namespace {

py::object typeOf(ElementType type) {
  constexpr const char* kNames[] = {"u1", "<u2", "<i4", "<f4", "<f8"};
  return py::dtype(kNames[static_cast<std::size_t>(type)]);
}

py::dict arraysOf(const std::shared_ptr<TableFile>& file) {
  py::dict all;
  const py::object owner = py::cast(file);
  for (const TableArray& one : file->arrays()) {
    std::vector<py::ssize_t> shape(one.shape.begin(), one.shape.end());
    all[py::str(one.name)] =
        readOnly(py::array(py::dtype(typeOf(one.type)), shape, one.bytes.data(), owner));
  }
  return all;
}

/// A robot, and Python's threads at its container.
struct SharedRobot {
  std::shared_ptr<Robot> robot;
  std::shared_ptr<Gate> gate = containerGate();
};

/// The whole field of view that a format tells [rad], or None.
py::object viewOf(const Format& format) {
  double opening = std::nan("");
  if (format.name() == formats::kScan)
    opening = format.number("step_deg") * (format.number("beams") - 1.0);
  if (format.name() == formats::kCone) opening = format.number("opening_deg");
  return std::isnan(opening) ? py::object(py::none()) : py::float_(radians(std::abs(opening)));
}

py::dict sensorsOf(const SharedRobot& self) {
  const Gate::Together visit(*self.gate);
  py::dict all;
  for (const auto& one : self.robot->container.all()) {
    const Format format = one->format();
    if (format.name() == formats::kOdometry || format.name() == formats::kPose) continue;
    py::dict sensor;
    sensor["mount"] = tupleOf(one->mount());
    sensor["fov"] = viewOf(format);
    all[py::str(toText(one->id()))] = sensor;
  }
  return all;
}

/// A source whose readings Python goes through.
struct Readings {
  std::unique_ptr<PluginFactory> factory;
  std::unique_ptr<Source> source;
  Gate gate{"these Readings"};
  OpenedHere opened;
  std::string name;

  ~Readings() {
    if (!gate.isBroken()) return;
    leave(source);
    leave(factory);
  }
};

py::tuple nextReading(Readings& readings) {
  readings.opened.check("these Readings");
  Message message;
  const bool isThere = alone(readings.gate, [&] { return readings.source->next(message); });
  if (!isThere) throw py::stop_iteration();
  return py::make_tuple(message.stamp, toText(message.id), copyOf(message.words));
}

/// Names below a folder of the maps.
std::vector<std::string> namesIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// The path of a shipped file. @throws FileNotFoundError that says which one is near
std::filesystem::path needShipped(const std::filesystem::path& kind,
                                  const std::filesystem::path& file) {
  std::filesystem::path found = shippedFile(kind, file);
  std::error_code none;
  if (found.is_absolute() || std::filesystem::exists(found, none)) return found;
  const std::filesystem::path maps =
      shippedFile("robots", "pioneer.toml").parent_path().parent_path();
  const std::vector<std::string> kinds = namesIn(maps);
  std::string text;
  if (std::find(kinds.begin(), kinds.end(), kind.string()) == kinds.end())
    text = "there are no shipped '" + kind.string() + "'" + didYouMean(kind.string(), kinds);
  else
    text = "there is no '" + file.string() + "' among the shipped " + kind.string() +
           didYouMean(file.string(), namesIn(maps / kind));
  text += "; looked in " + (maps / kind).string() + " and in the working folder";
  PyErr_SetString(PyExc_FileNotFoundError, text.c_str());
  throw py::error_already_set();
}

void bindTables(py::module_& module) {
  py::class_<TableFile, std::shared_ptr<TableFile>>(module, "Tables",
                                                    "A table file, mapped: arrays are no copies.")
      .def(py::init(
               [](const std::filesystem::path& file) { return std::make_shared<TableFile>(file); }),
           py::arg("file"), "Maps a file of `ortung learn`.")
      .def_property_readonly("arrays", &arraysOf,
                             "All arrays by name, to be read only; numpy.load reads the same.")
      .def_property_readonly(
          "meta",
          [](const TableFile& self) {
            return py::module_::import("json").attr("loads")(self.text("meta.json"));
          },
          "What the file says of itself: world, robot, features, cells.")
      .def("__repr__", [](const TableFile& self) {
        return "Tables('" + self.path().string() + "', " + std::to_string(self.arrays().size()) +
               " arrays)";
      });
}

void bindReadings(py::module_& module) {
  py::class_<Readings>(module, "Readings",
                       "Goes through (stamp [us], 'model/type/feature', words) of any source.")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &nextReading)
      .def_property_readonly(
          "world",
          [](Readings& self) {
            return alone(self.gate, [&] { return self.source->worldFingerprint(); });
          },
          "The fingerprint of the world that they come from, or ''.")
      .def_property_readonly(
          "remark",
          [](Readings& self) { return alone(self.gate, [&] { return self.source->remark(); }); },
          "What the user should know at the end, e.g. that a record is torn, or ''.")
      .def("__repr__", [](const Readings& self) { return "Readings('" + self.name + "')"; });
}

}  // namespace

void bindRobots(py::module_& module) {
  py::class_<SharedRobot>(module, "Robot", "A robot as its file describes it.")
      .def(py::init([](const std::filesystem::path& robot,
                       const std::optional<std::filesystem::path>& tables) {
             return SharedRobot{tables ? openRobot(robot, *tables) : openRobot(robot)};
           }),
           py::arg("robot"), py::arg("tables") = py::none(),
           "Reads a robot file, and the tables with which its features can weigh.")
      .def_property_readonly(
          "name", [](const SharedRobot& self) { return self.robot->config.name; }, "Its name.")
      .def_property_readonly(
          "radius", [](const SharedRobot& self) { return self.robot->config.radius; },
          "Of the circle around its origin that its body fills [m].")
      .def_property_readonly("sensors", &sensorsOf,
                             "Where each feature's sensor sits: mount (x, y [m], heading [rad]) in "
                             "the robot's frame and fov, its whole field of view [rad], or None. "
                             "Odometry and ground truth are not among them.")
      .def("__repr__",
           [](const SharedRobot& self) {
             return "Robot('" + self.robot->config.name + "', " +
                    std::to_string(self.robot->container.all().size()) + " features)";
           })
      .def_property_readonly(
          "container",
          [](const SharedRobot& self) {
            return Container{self.robot, &self.robot->container, self.gate};
          },
          "Its features with their newest readings.");
  bindTables(module);
  bindReadings(module);
  module.def(
      "shipped_file", &needShipped, py::arg("kind"), py::arg("file"),
      "The path of a map that ships with Ortung, e.g. ('robots', 'pioneer.toml'); an absolute path "
      "and a file that is there as they are. FileNotFoundError names the nearest one otherwise.");
  module.def(
      "readings",
      [](const std::string& source, const std::filesystem::path& robot) {
        auto readings = std::make_unique<Readings>();
        readings->name = source;
        readings->factory = std::make_unique<PluginFactory>(PluginFactory::standardFolders());
        readings->source = openSource(source, robot, *readings->factory);
        return readings;
      },
      py::arg("source"), py::arg("robot") = "",
      "Of 'KIND:PATH?key=value', e.g. 'record:run.rec', 'sim:scene.toml'.");
}

}  // namespace ortung::python

// Robots, tables and records.
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <string>

#include "Bindings.hpp"
#include "Robots.hpp"
#include "ortung/core/ShippedFiles.hpp"
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

/// A source whose readings Python goes through.
struct Readings {
  std::unique_ptr<PluginFactory> factory;
  std::unique_ptr<Source> source;
  Gate gate{"these Readings"};
  OpenedHere opened;

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

}  // namespace

void bindRobots(py::module_& module) {
  py::class_<SharedRobot>(module, "Robot", "A robot as its file describes it.")
      .def(py::init([](const std::filesystem::path& robot,
                       const std::optional<std::filesystem::path>& tables) {
             return SharedRobot{tables ? openRobot(robot, *tables) : openRobot(robot)};
           }),
           py::arg("robot"), py::arg("tables") = py::none())
      .def_property_readonly("name",
                             [](const SharedRobot& self) { return self.robot->config.name; })
      .def_property_readonly("container", [](const SharedRobot& self) {
        return Container{self.robot, &self.robot->container, self.gate};
      });
  py::class_<TableFile, std::shared_ptr<TableFile>>(module, "Tables",
                                                    "A table file, mapped: arrays are no copies.")
      .def(py::init(
               [](const std::filesystem::path& file) { return std::make_shared<TableFile>(file); }),
           py::arg("file"))
      .def_property_readonly("arrays", &arraysOf)
      .def_property_readonly("meta", [](const TableFile& self) {
        return py::module_::import("json").attr("loads")(self.text("meta.json"));
      });
  py::class_<Readings>(module, "Readings",
                       "Goes through (stamp [us], 'model/type/feature', words) of any source.")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &nextReading)
      .def_property_readonly("world",
                             [](Readings& self) {
                               return alone(self.gate,
                                            [&] { return self.source->worldFingerprint(); });
                             })
      .def_property_readonly("remark", [](Readings& self) {
        return alone(self.gate, [&] { return self.source->remark(); });
      });
  module.def(
      "shipped_file", &shippedFile, py::arg("kind"), py::arg("file"),
      "The path of a map that ships with Ortung, e.g. ('robots', 'pioneer.toml'); a file that "
      "is there, or that is not among them, as it is.");
  module.def(
      "readings",
      [](const std::string& source, const std::filesystem::path& robot) {
        auto readings = std::make_unique<Readings>();
        readings->factory = std::make_unique<PluginFactory>(PluginFactory::standardFolders());
        readings->source = openSource(source, robot, *readings->factory);
        return readings;
      },
      py::arg("source"), py::arg("robot") = "",
      "Of 'KIND:PATH?key=value', e.g. 'record:run.rec', 'sim:scene.toml'.");
}

}  // namespace ortung::python

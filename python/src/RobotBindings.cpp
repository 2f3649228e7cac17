// Robots, their containers, tables and records.
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>

#include "Bindings.hpp"
#include "Robots.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung::python {
namespace {

using Words = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

template <class List, class Row>
py::object table(const List& list, py::ssize_t columns, const Row& row) {
  py::array_t<double> all({static_cast<py::ssize_t>(list.size()), columns});
  double* out = all.mutable_data();
  for (const auto& one : list)
    for (const double value : row(one)) *out++ = value;
  return all;
}

py::object numbersOf(std::initializer_list<double> numbers) {
  return copyOf(std::vector<double>(numbers));
}

/// The newest reading in metres and radians; a feature of no known format gives its words.
py::object readingOf(const SensorData& data) {
  if (data.sequence() == 0) return py::none();
  if (const auto* scan = dynamic_cast<const ScanData*>(&data))
    return copyOf(scan->reading().ranges);
  if (const auto* pose = dynamic_cast<const PoseData*>(&data))
    return numbersOf({pose->reading().x, pose->reading().y, pose->reading().theta});
  if (const auto* odometry = dynamic_cast<const OdometryData*>(&data)) {
    const auto& r = odometry->reading();
    return numbersOf({r.pose.x, r.pose.y, r.pose.theta, r.translationalVelocity, r.lateralVelocity,
                      r.rotationalVelocity});
  }
  if (const auto* scalar = dynamic_cast<const ScalarData*>(&data))
    return numbersOf({scalar->reading().value_or(std::nan(""))});
  if (const auto* bearing = dynamic_cast<const BearingData*>(&data))
    return numbersOf({bearing->reading().value_or(std::nan(""))});
  if (const auto* cone = dynamic_cast<const ConeData*>(&data)) return numbersOf({cone->reading()});
  if (const auto* landmarks = dynamic_cast<const LandmarksData*>(&data))
    return table(landmarks->reading(), 3, [](const auto& one) {
      return std::array{static_cast<double>(one.identity), one.range, one.bearing};
    });
  if (const auto* points = dynamic_cast<const PointsData*>(&data))
    return table(points->reading(), 2,
                 [](const auto& one) { return std::array{one.range, one.bearing}; });
  if (const auto* objects = dynamic_cast<const ObjectsData*>(&data))
    return table(objects->reading(), 3,
                 [](const auto& one) { return std::array{one.range, one.bearing, one.radius}; });
  const auto words = data.getData();
  return copyOf(std::vector<std::uint32_t>(words.begin(), words.end()));
}

SensorData& need(SensorContainer& container, const std::string& query) {
  SensorData* found = container.find(parseSensorQuery(query));
  if (found != nullptr) return *found;
  std::string known;
  for (const auto& one : container.all()) known += (known.empty() ? "" : ", ") + toText(one->id());
  throw py::key_error("there is no feature " + query + ", but " + known);
}

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

/// A source whose readings Python goes through.
struct Readings {
  std::unique_ptr<PluginFactory> factory;
  std::unique_ptr<Source> source;
};

py::tuple nextReading(Readings& readings) {
  Message message;
  bool isThere = false;
  {
    const py::gil_scoped_release others;
    isThere = readings.source->next(message);
  }
  if (!isThere) throw py::stop_iteration();
  return py::make_tuple(message.stamp, toText(message.id), copyOf(message.words));
}

void bindContainer(py::module_& module) {
  py::class_<Container>(module, "SensorContainer",
                        "A robot's newest readings. Features are named 'model/type/feature'; '*' "
                        "stands for any.")
      .def_property_readonly("features",
                             [](const Container& self) {
                               std::vector<std::string> all;
                               for (const auto& one : self.container->all())
                                 all.push_back(toText(one->id()));
                               return all;
                             })
      .def(
          "get",
          [](const Container& self, const std::string& query) {
            const SensorContainer::ReadLock lock = self.container->read();
            return readingOf(need(*self.container, query));
          },
          py::arg("feature"),
          "The newest reading in metres and radians, or None. Scan: ranges; pose: x, y, heading; "
          "odometry: pose, velocities forward, left, turn; landmarks: (n, 3) identity, range, "
          "bearing; points: (n, 2) range, bearing; objects: (n, 3) range, bearing, radius.")
      .def(
          "words",
          [](const Container& self, const std::string& query) {
            const SensorContainer::ReadLock lock = self.container->read();
            const auto words = need(*self.container, query).getData();
            return copyOf(std::vector<std::uint32_t>(words.begin(), words.end()));
          },
          py::arg("feature"), "The newest reading as a record has it.")
      .def(
          "stamp",
          [](const Container& self, const std::string& query) -> py::object {
            const SensorContainer::ReadLock lock = self.container->read();
            const SensorData& data = need(*self.container, query);
            return data.sequence() == 0 ? py::object(py::none()) : py::cast(data.stamp());
          },
          py::arg("feature"), "Of the newest reading [us], or None.")
      .def(
          "help",
          [](const Container& self, const std::string& query) {
            return need(*self.container, query).wordsHelp();
          },
          py::arg("feature"), "What its words mean.")
      .def(
          "set",
          [](const Container& self, std::int64_t stamp, const std::string& feature,
             const Words& words) {
            const SensorId id = parseSensorId(feature);
            if (self.container->findExactly(id) == nullptr) need(*self.container, feature);
            Message message{stamp, id, {words.data(), words.data() + words.size()}};
            const py::gil_scoped_release others;
            self.container->set(message);
          },
          py::arg("stamp"), py::arg("feature"), py::arg("words"))
      .def(
          "expectation",
          [](const Container& self, const std::string& query, double x, double y, double theta) {
            return copyOf(need(*self.container, query).expectation({x, y, theta}));
          },
          py::arg("feature"), py::arg("x"), py::arg("y"), py::arg("theta"),
          "What the feature should read at a pose, by its tables.")
      .def(
          "probability",
          [](const Container& self, double x, double y, double theta) {
            const SensorContainer::ReadLock lock = self.container->read();
            return self.container->getProbability(Pose2{x, y, theta});
          },
          py::arg("x"), py::arg("y"), py::arg("theta"), "p(s|l) of all readings at a pose.");
}

}  // namespace

void bindRobots(py::module_& module) {
  bindContainer(module);
  py::class_<Robot, std::shared_ptr<Robot>>(module, "Robot", "A robot as its file describes it.")
      .def(py::init([](const std::filesystem::path& robot,
                       const std::optional<std::filesystem::path>& tables) {
             return std::shared_ptr<Robot>(tables ? openRobot(robot, *tables) : openRobot(robot));
           }),
           py::arg("robot"), py::arg("tables") = py::none())
      .def_property_readonly("name", [](const Robot& self) { return self.config.name; })
      .def_property_readonly("container", [](const std::shared_ptr<Robot>& self) {
        return Container{self, &self->container};
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
                             [](const Readings& self) { return self.source->worldFingerprint(); })
      .def_property_readonly("remark", [](const Readings& self) { return self.source->remark(); });
  module.def(
      "readings",
      [](const std::string& source, const std::filesystem::path& robot) {
        Readings readings{std::make_unique<PluginFactory>(PluginFactory::standardFolders()),
                          nullptr};
        readings.source = openSource(source, robot, *readings.factory);
        return readings;
      },
      py::arg("source"), py::arg("robot") = "",
      "Of 'KIND:PATH?key=value', e.g. 'record:run.rec', 'sim:scene.toml'.");
}

}  // namespace ortung::python

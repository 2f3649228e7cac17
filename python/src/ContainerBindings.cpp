// Containers: readings, what they learn, and how probable they are.
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

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

namespace ortung::python {
namespace {

using Words = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

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

/// The newest reading in metres and radians, by the name of its format; one of a plugin's own gives
/// its words.
py::object readingOf(const SensorData& data) {
  if (data.sequence() == 0) return py::none();
  if (const auto scan = readingAs<ScanData>(data)) return copyOf(scan->ranges);
  if (const auto pose = readingAs<PoseData>(data))
    return numbersOf({pose->x, pose->y, pose->theta});
  if (const auto r = readingAs<OdometryData>(data))
    return numbersOf({r->pose.x, r->pose.y, r->pose.theta, r->translationalVelocity,
                      r->lateralVelocity, r->rotationalVelocity});
  if (const auto scalar = readingAs<ScalarData>(data))
    return numbersOf({scalar->value_or(std::nan(""))});
  if (const auto bearing = readingAs<BearingData>(data))
    return numbersOf({bearing->value_or(std::nan(""))});
  if (const auto cone = readingAs<ConeData>(data)) return numbersOf({*cone});
  if (const auto landmarks = readingAs<LandmarksData>(data))
    return table(*landmarks, 3, [](const auto& one) {
      return std::array{static_cast<double>(one.identity), one.range, one.bearing};
    });
  if (const auto points = readingAs<PointsData>(data))
    return table(*points, 2, [](const auto& one) { return std::array{one.range, one.bearing}; });
  if (const auto objects = readingAs<ObjectsData>(data))
    return table(*objects, 3,
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

/// One feature and its words by pose, all checked before any is learned.
void learn(const Container& self, const std::string& query, const FieldRegion& region,
           const py::sequence& words, const std::optional<Numbers>& poses, double headingStep) {
  SensorData& data = need(*self.container, query);
  if (poses && (poses->ndim() != 2 || poses->shape(1) != 3))
    throw py::value_error("poses must have the shape (N, 3): x, y, heading");
  const std::size_t count = poses ? static_cast<std::size_t>(poses->shape(0)) : region.grid.size();
  if (py::len(words) != count)
    throw py::value_error(std::to_string(py::len(words)) + " readings for " +
                          std::to_string(count) + " poses");
  std::vector<std::vector<std::uint32_t>> readings;
  for (const py::object one : words) {  // rows of an array are made as they are asked for
    const auto numbers = py::cast<Words>(one);
    readings.emplace_back(numbers.data(), numbers.data() + numbers.size());
    data.checkData(readings.back());
  }
  data.beginLearning(region, headingStep);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    const Pose2 pose = poses ? Pose2{poses->at(row, 0), poses->at(row, 1), poses->at(row, 2)}
                             : Pose2{region.grid.centreX(i), region.grid.centreY(i), 0.0};
    data.setData(0, readings[i]);
    data.learnProbability(pose);
  }
  data.endLearning();
}

void addScalar(const Container& self, const std::string& feature, double maxRange, double sigma,
               double outliers) {
  if (!(maxRange > 0.0) || !std::isfinite(maxRange))
    throw py::value_error(feature + ": max_range must be positive [m]");
  if (!(sigma > 0.0) || !std::isfinite(sigma))
    throw py::value_error(feature + ": sigma must be positive [m]");
  if (!(outliers > 0.0 && outliers < 1.0))
    throw py::value_error(feature + ": outliers must be in (0, 1)");
  ScalarData::Config config{maxRange, 0.0, {}};
  config.model.sigma = sigma;
  config.model.outliers = outliers;
  self.container->add(std::make_unique<ScalarData>(parseSensorId(feature), Pose2{}, config));
}

FieldRegion makeRegion(int columns, int rows, double cell, double x, double y) {
  FieldRegion region{{x, y, cell, columns, rows}, {}, {}, 0.0};
  if (columns > 0 && rows > 0) {
    region.open.assign(region.grid.size(), 1);
    region.standable = region.open;
  }
  region.check();
  return region;
}

py::object centresOf(const FieldRegion& region) {
  std::vector<std::size_t> cells(region.grid.size());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  return table(cells, 2, [&](std::size_t cell) {
    return std::array{region.grid.centreX(cell), region.grid.centreY(cell)};
  });
}

}  // namespace

void bindContainer(py::module_& module) {
  py::class_<FieldRegion>(module, "FieldRegion",
                          "The part of the plane that is learned: cells [m] from a lower left "
                          "corner on, all of them open.")
      .def(py::init(&makeRegion), py::arg("columns"), py::arg("rows"), py::arg("cell"),
           py::arg("x") = 0.0, py::arg("y") = 0.0)
      .def_property_readonly("centres", &centresOf, "Of the cells, (N, 2), row by row [m].");
  py::class_<Container>(module, "SensorContainer",
                        "A robot's newest readings. Features are named 'model/type/feature'; '*' "
                        "stands for any.")
      .def(py::init([] {
        const auto own = std::make_shared<SensorContainer>();
        return Container{own, own.get()};
      }))
      .def("add_scalar", &addScalar, py::arg("feature"), py::arg("max_range") = 20.0,
           py::arg("sigma") = 0.05, py::arg("outliers") = 0.05,
           "A feature that is one distance. Its words: [mm], or none where nothing was seen.")
      .def("learn", &learn, py::arg("feature"), py::arg("region"), py::arg("words"),
           py::arg("poses") = py::none(), py::arg("heading_step") = 0.1,
           "Takes noise-free words as what the feature reads at poses (N, 3); without them at the "
           "centres of the region's cells, with heading 0. Forgets what it had learned, and leaves "
           "the last of the words as its reading.")
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
          py::arg("feature"), "What its words mean, for people.")
      .def(
          "format",
          [](const Container& self, const std::string& query) {
            return need(*self.container, query).format().toText();
          },
          py::arg("feature"), "What its words mean, for programs: a name and parameters.")
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

}  // namespace ortung::python

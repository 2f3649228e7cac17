// Containers: readings, what they learn, and how probable they are.
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "Bindings.hpp"
#include "FeatureNames.hpp"
#include "OwnSensor.hpp"
#include "Robots.hpp"
#include "Values.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace ortung::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

SensorData& find(const Container& self, const std::string& query) {
  const Gate::Together visit(*self.gate);
  return needFeature(*self.container, query);
}

/// The newest readings, which stay while this lives. It waits for them without Python's lock.
class Look {
 public:
  explicit Look(const Container& self) : visit_(*self.gate) {
    const py::gil_scoped_release others;
    lock_ = self.container->read();
  }

 private:
  Gate::Together visit_;
  SensorContainer::ReadLock lock_;
};

/// One feature and its readings by pose, all checked before any is learned.
/// @param wordsOf makes words of one of them
template <class WordsOf>
void learn(const Container& self, SensorData& data, const FieldRegion& region,
           const py::sequence& given, const py::object& where, double headingStep,
           const WordsOf& wordsOf) {
  std::optional<Numbers> poses;
  if (!where.is_none()) poses = realNumbers<double>(where, "poses");
  if (poses && (poses->ndim() != 2 || poses->shape(1) != 3))
    throw py::value_error("poses must have the shape (N, 3): x, y, heading");
  const std::size_t count = poses ? static_cast<std::size_t>(poses->shape(0)) : region.grid.size();
  if (py::len(given) != count)
    throw py::value_error(std::to_string(py::len(given)) + " readings for " +
                          std::to_string(count) + " poses");
  std::vector<std::vector<std::uint32_t>> readings;
  for (const py::object one : given) {  // rows of an array are made as they are asked for
    readings.push_back(wordsOf(one));
    data.checkData(readings.back());
  }
  alone(*self.gate, [&] {
    data.beginLearning(region, headingStep);
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = static_cast<py::ssize_t>(i);
      const Pose2 pose = poses ? Pose2{poses->at(row, 0), poses->at(row, 1), poses->at(row, 2)}
                               : Pose2{region.grid.centreX(i), region.grid.centreY(i), 0.0};
      data.setData(0, readings[i]);
      data.learnProbability(pose);
    }
    data.endLearning();
  });
}

void learnWords(const Container& self, const std::string& query, const FieldRegion& region,
                const py::sequence& words, const py::object& poses, double headingStep) {
  SensorData& data = find(self, query);
  learn(self, data, region, words, poses, headingStep,
        [&](const py::object& one) { return wordsOf(one, toText(data.id())); });
}

void learnValues(const Container& self, const std::string& query, const FieldRegion& region,
                 const py::sequence& values, const py::object& poses, double headingStep) {
  SensorData& data = find(self, query);
  learn(self, data, region, values, poses, headingStep,
        [&](const py::object& one) { return encode(data, one); });
}

void set(const Container& self, Timestamp stamp, const SensorId& id,
         std::vector<std::uint32_t> words) {
  const Message message{stamp, id, std::move(words)};
  const Gate::Together visit(*self.gate);
  const py::gil_scoped_release others;
  self.container->set(message);
}

/// The feature of this very name.
SensorData& exactly(const Container& self, const std::string& feature) {
  const Gate::Together visit(*self.gate);
  const SensorId id = featureIdOf(feature, self.container);
  SensorData* found = self.container->findExactly(id);
  return found != nullptr ? *found : needFeature(*self.container, feature);
}

void setWords(const Container& self, Timestamp stamp, const std::string& feature,
              const py::object& words) {
  set(self, stamp, exactly(self, feature).id(), wordsOf(words, feature));
}

void setValues(const Container& self, Timestamp stamp, const std::string& feature,
               const py::object& values) {
  const SensorData& data = exactly(self, feature);
  set(self, stamp, data.id(), encode(data, values));
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
  auto data = std::make_unique<ScalarData>(featureIdOf(feature), Pose2{}, config);
  alone(*self.gate, [&] { self.container->add(std::move(data)); });
}

void addSensor(const Container& self, const std::string& feature, const py::object& sensor,
               std::size_t values) {
  auto data = makeOwnSensor(feature, sensor, values);
  alone(*self.gate, [&] { self.container->add(std::move(data)); });
}

std::string reprOf(const Container& self) {
  const Gate::Together visit(*self.gate);
  std::string names;
  for (const auto& one : self.container->all())
    names += (names.empty() ? "" : ", ") + toText(one->id());
  return "SensorContainer(" + (names.empty() ? "no features" : names) + ")";
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

std::string reprOf(const FieldRegion& region) {
  char text[120];
  std::snprintf(text, sizeof text, "FieldRegion(columns=%d, rows=%d, cell=%g, x=%g, y=%g)",
                region.grid.columns, region.grid.rows, region.grid.cell, region.grid.originX,
                region.grid.originY);
  return text;
}

py::array maskOf(const FieldGrid& grid, const std::vector<std::uint8_t>& mask) {
  return copyOf(mask).view("bool").reshape(
      {static_cast<py::ssize_t>(grid.rows), static_cast<py::ssize_t>(grid.columns)});
}

py::object centresOf(const FieldRegion& region) {
  return tableOf(static_cast<py::ssize_t>(region.grid.size()), 2, [&](py::ssize_t i) {
    const auto cell = static_cast<std::size_t>(i);
    return std::array{region.grid.centreX(cell), region.grid.centreY(cell)};
  });
}

using PyContainer = py::class_<Container>;

/// What features read.
void bindReadings(PyContainer& container) {
  container
      .def_property_readonly(
          "features",
          [](const Container& self) {
            const Gate::Together visit(*self.gate);
            return namesOf(*self.container);
          },
          "The names of all features, in the order of the robot file.")
      .def(
          "get",
          [](const Container& self, const std::string& query) {
            const Look look(self);
            return readingOf(needFeature(*self.container, query));
          },
          py::arg("feature"),
          "The newest reading in metres and radians, or None. Scan: ranges; pose: x, y, heading; "
          "odometry: pose, velocities forward, left, turn; landmarks: (n, 3) identity, range, "
          "bearing; points: (n, 2) range, bearing; objects: (n, 3) range, bearing, radius.")
      .def(
          "words",
          [](const Container& self, const std::string& query) {
            const Look look(self);
            const auto words = needFeature(*self.container, query).getData();
            return copyOf(std::vector<std::uint32_t>(words.begin(), words.end()));
          },
          py::arg("feature"), "The newest reading as a record has it.")
      .def(
          "stamp",
          [](const Container& self, const std::string& query) -> py::object {
            const Look look(self);
            const SensorData& data = needFeature(*self.container, query);
            return data.sequence() == 0 ? py::object(py::none()) : py::cast(data.stamp());
          },
          py::arg("feature"), "Of the newest reading [us], or None.")
      .def(
          "help",
          [](const Container& self, const std::string& query) {
            return find(self, query).wordsHelp();
          },
          py::arg("feature"), "What its words mean, for people.")
      .def(
          "format",
          [](const Container& self, const std::string& query) {
            return find(self, query).format().toText();
          },
          py::arg("feature"), "What its words mean, for programs: a name and parameters.")
      .def("set", &setWords, py::arg("stamp"), py::arg("feature"), py::arg("words"),
           "Sets a reading by its words: an array of uint32, or whole numbers of Python.")
      .def("set_values", &setValues, py::arg("stamp"), py::arg("feature"), py::arg("values"),
           "Sets a reading in metres and radians, in the order of get(). A range of NaN is not "
           "valid, an infinite one means that nothing was seen, as a distance or bearing of NaN "
           "does.");
}

/// What features learn, and what they make of readings.
void bindModels(PyContainer& container) {
  container
      .def("add_scalar", &addScalar, py::arg("feature"), py::arg("max_range") = 20.0,
           py::arg("sigma") = 0.05, py::arg("outliers") = 0.05,
           "A feature that is one distance. Its words: [mm], or none where nothing was seen.")
      .def("learn", &learnWords, py::arg("feature"), py::arg("region"), py::arg("words"),
           py::arg("poses") = py::none(), py::arg("heading_step") = 0.1,
           "Takes noise-free words as what the feature reads at poses (N, 3); without them at the "
           "centres of the region's cells, with heading 0. Forgets what it had learned, and leaves "
           "the last of the words as its reading, at the time 0.")
      .def("learn_values", &learnValues, py::arg("feature"), py::arg("region"), py::arg("values"),
           py::arg("poses") = py::none(), py::arg("heading_step") = 0.1,
           "Takes noise-free readings in metres and radians, each as get() gives it, as what the "
           "feature reads at poses (N, 3): x, y [m], heading [rad]; without them at the centres of "
           "the region's cells, with heading 0, one value for each. heading_step [rad] divides the "
           "turn of features that depend on the heading. Forgets what the feature had learned, and "
           "leaves the last of the values as its reading, at the time 0. Until then the feature "
           "can't weigh, so it comes before localizing. KeyError for a feature that is not there, "
           "ValueError for readings that it can't have; then nothing is learned.")
      .def(
          "expectation",
          [](const Container& self, const std::string& query, double x, double y, double theta) {
            const Look look(self);
            return copyOf(needFeature(*self.container, query).expectation({x, y, theta}));
          },
          py::arg("feature"), py::arg("x"), py::arg("y"), py::arg("theta"),
          "What the feature should read at a pose, by its tables.")
      .def(
          "probability",
          [](const Container& self, double x, double y, double theta) {
            const Look look(self);
            const double p = self.container->getProbability(Pose2{x, y, theta});
            raiseFailures(*self.container);
            return p;
          },
          py::arg("x"), py::arg("y"), py::arg("theta"),
          "p(s|l) of all readings at a pose, in [0, 1]; 1 for a perfect match. -1 if none can "
          "weigh, "
          "wherever the robot is: there is no reading yet, or no feature that was learned.")
      .def("add_sensor", &addSensor, py::arg("feature"), py::arg("sensor"), py::arg("values") = 1,
           "A feature of so many numbers that a Python object knows how to weigh. Poses go to it "
           "as (N, 3): x, y, heading, readings as (values,). It has `probability(reading, poses)`, "
           "p in [0, 1] for each pose, (N,); or `expected(poses)`, what it should read at each, "
           "(N, values), NaN where nothing is expected, and the standard deviation `sigma`; "
           "`is_angle` (False) says whether these are angles. `outliers` (0.05) is p where nothing "
           "fits. With `learn(pose, reading)` it learns from learn_values(). It must not use this "
           "container.");
}

}  // namespace

void bindContainer(py::module_& module) {
  py::class_<FieldRegion>(module, "FieldRegion",
                          "The part of the plane that is learned: cells [m] from a lower left "
                          "corner on, all of them open.")
      .def(py::init(&makeRegion), py::arg("columns"), py::arg("rows"), py::arg("cell"),
           py::arg("x") = 0.0, py::arg("y") = 0.0,
           "Makes columns x rows cells with edges of `cell` [m]; x, y [m] are the lower left "
           "corner.")
      .def_property_readonly("centres", &centresOf, "Of the cells, (N, 2), row by row [m].")
      .def_property_readonly(
          "open", [](const FieldRegion& self) { return maskOf(self.grid, self.open); },
          "Whether a cell's centre is inside nothing solid, (rows, columns), from the lower left "
          "corner.")
      .def_property_readonly(
          "standable", [](const FieldRegion& self) { return maskOf(self.grid, self.standable); },
          "Whether the robot has room with its centre there, (rows, columns).")
      .def_property_readonly(
          "cell", [](const FieldRegion& self) { return self.grid.cell; }, "Edge of a cell [m].")
      .def_property_readonly(
          "extent", [](const FieldRegion& self) { return extentOf(self.grid); },
          "x, x, y, y of its edges [m].")
      .def("__repr__", [](const FieldRegion& self) { return reprOf(self); });
  PyContainer container(module, "SensorContainer",
                        "A robot's newest readings. Features are named 'model/type/feature'; '*' "
                        "stands for any.");
  container.def(py::init([] {
                  const auto own = std::make_shared<SensorContainer>();
                  return Container{own, own.get(), containerGate()};
                }),
                "Makes an empty container.");
  container.def("__repr__", [](const Container& self) { return reprOf(self); });
  bindReadings(container);
  bindModels(container);
}

}  // namespace ortung::python

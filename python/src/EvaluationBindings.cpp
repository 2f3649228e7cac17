// Runs that are compared with ground truth.
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Bindings.hpp"
#include "OwnSensor.hpp"
#include "Progress.hpp"
#include "Starts.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/study/Figures.hpp"
#include "ortung/study/RunEvaluation.hpp"

namespace ortung::python {
namespace {

struct Evaluated {
  EvaluatedRun run;
  std::string robot;
  std::string world;
};

void add(py::dict& all, const NamedFigures& figures) {
  for (const NamedFigure& one : figures)
    all[one.name] = one.isCount ? py::object(py::int_(static_cast<std::size_t>(one.value)))
                                : py::object(py::float_(one.value));
}

py::dict figuresOf(const Evaluated& self) {
  const EvaluationResult& result = self.run.figures;
  py::dict all;
  add(all, errorFigures(result));
  py::dict quality;
  quality["calibration_error"] = self.run.calibration.error;
  quality["area_under_curve"] = self.run.calibration.area;
  all["quality"] = quality;
  add(all, timeFigures(result));
  add(all, consistencyFigures(result));
  py::dict corrections;
  add(corrections, correctionFigures(result));
  all["at_corrections"] = corrections;
  add(all, protectionFigures(result));
  return all;
}

/// A number of each point at which truth is known.
template <class Number>
py::array column(const Evaluated& self, const Number& number) {
  std::vector<double> values;
  for (const EvaluationPoint& point : self.run.figures.points) values.push_back(number(point));
  return copyOf(values);
}

/// Poses of the points, (n, 3).
template <class Pose>
py::array poses(const Evaluated& self, const Pose& pose) {
  const auto& points = self.run.figures.points;
  return tableOf(static_cast<py::ssize_t>(points.size()), 3, [&](py::ssize_t i) {
    const Pose2& one = pose(points[static_cast<std::size_t>(i)]);
    return std::array{one.x, one.y, one.theta};
  });
}

double secondsOf(const Evaluated& self, Timestamp stamp) {
  return toSeconds(stamp - self.run.first);
}

py::array pathOf(const Evaluated& self) {
  const auto& path = self.run.path;
  return tableOf(static_cast<py::ssize_t>(path.size()), 4, [&](py::ssize_t i) {
    const PoseEstimate& one = path[static_cast<std::size_t>(i)];
    return std::array{secondsOf(self, one.stamp), one.pose.x, one.pose.y, one.pose.theta};
  });
}

py::array statusOf(const Evaluated& self) {
  py::list names;
  for (const EvaluationPoint& point : self.run.figures.points) names.append(nameOf(point.status));
  return py::module_::import("numpy").attr("array")(names, py::arg("dtype") = "U9");
}

std::string reprOf(const Evaluated& self) {
  const EvaluationErrors& errors = self.run.figures.overTime;
  char text[160];
  std::snprintf(text, sizeof text,
                ", %.1f s, position_rmse_m=%.3f, heading_rmse_deg=%.2f, lost_share=%.3f)",
                self.run.figures.duration, errors.positionRmse, degrees(errors.headingRmse),
                errors.lostShare);
  return "EvaluatedRun('" + self.run.figures.source + "'" + text;
}

/// Makes the features of a dict of sensors by name, each alone or with the number of its values.
std::vector<std::unique_ptr<SensorData>> ownSensors(const std::optional<py::dict>& sensors) {
  std::vector<std::unique_ptr<SensorData>> all;
  if (!sensors) return all;
  for (const auto& [key, value] : *sensors) {
    const auto name = py::cast<std::string>(key);
    const bool isPair = py::isinstance<py::tuple>(value) && py::len(value) == 2;
    const auto pair =
        isPair ? py::reinterpret_borrow<py::tuple>(value) : py::make_tuple(value, std::size_t{1});
    if (py::hasattr(pair[0], "learn"))
      throw py::value_error(name +
                            ": the sensor has learn(), but evaluate() has nothing that it "
                            "could learn from; expected one that knows what it reads");
    all.push_back(makeOwnSensor(name, pair[0], py::cast<std::size_t>(pair[1])));
  }
  return all;
}

/// Evaluates, and raises what a sensor of Python raised meanwhile. The caller does not hold
/// Python's lock.
EvaluatedRun evaluateWith(Localization& localization, const std::string& source,
                          const Evaluation::Options& options, bool hasOwnSensors,
                          ProgressTeller& teller) {
  const auto check = [&] {
    if (!hasOwnSensors) return;
    const py::gil_scoped_acquire python;
    raiseFailures(localization.container());
  };
  EvaluatedRun run = evaluate(localization, source, options, [&](double share) {
    check();
    return teller.tell(share);
  });
  check();
  return run;
}

Evaluated evaluateRun(const std::string& source, const std::filesystem::path& robot,
                      const std::filesystem::path& tables, std::uint64_t seed,
                      std::optional<std::size_t> particles, std::optional<unsigned> threads,
                      const py::object& start, double convergedMetres, double convergedDegrees,
                      const py::object& progress, bool anyWorld,
                      const std::optional<py::dict>& sensors) {
  const LocalizationConfig config =
      configOf(robot, tables, source, seed, particles, threads, start);
  if (source.empty()) throw py::value_error("source is '', expected 'KIND:PATH?key=value'");
  if (!(convergedMetres > 0.0) || !(convergedDegrees > 0.0))
    throw py::value_error("converged_m and converged_deg must be above 0");
  Evaluation::Options options;
  options.convergedMetres = convergedMetres;
  options.convergedRadians = radians(convergedDegrees);
  std::vector<std::unique_ptr<SensorData>> own = ownSensors(sensors);
  const bool hasOwnSensors = !own.empty();
  ProgressTeller teller(progress);
  const py::gil_scoped_release others;
  const std::unique_ptr<Localization> localization = localizationOf(config, anyWorld);
  for (std::unique_ptr<SensorData>& sensor : own) localization->container().add(std::move(sensor));
  Evaluated result;
  try {
    result.run = evaluateWith(*localization, source, options, hasOwnSensors, teller);
  } catch (const std::runtime_error&) {
    teller.raiseIfStopped();  // a run that was stopped at its begin has nothing to evaluate
    throw;
  }
  teller.raiseIfStopped();
  result.robot = localization->robot().config.name;
  result.world = localization->robot().tables.world;
  return result;
}

using PyRun = py::class_<Evaluated>;

void bindPoints(PyRun& run) {
  run.def_property_readonly(
         "times",
         [](const Evaluated& self) {
           return column(self, [&](const auto& p) { return secondsOf(self, p.stamp); });
         },
         "Times at which truth is known, from the first reading on [s], (n,).")
      .def_property_readonly(
          "truth",
          [](const Evaluated& self) {
            return poses(self, [](const auto& p) -> const Pose2& { return p.truth; });
          },
          "The true poses at these times in the field, (n, 3): x, y [m], heading [rad].")
      .def_property_readonly(
          "estimates",
          [](const Evaluated& self) {
            return poses(self, [](const auto& p) -> const Pose2& { return p.estimate; });
          },
          "The estimated poses at these times, (n, 3).")
      .def_property_readonly(
          "position_errors",
          [](const Evaluated& self) {
            return column(self, [](const auto& p) { return p.positionError; });
          },
          "Distances between the two [m], (n,).")
      .def_property_readonly(
          "heading_errors",
          [](const Evaluated& self) {
            return column(self, [](const auto& p) { return p.headingError; });
          },
          "Differences of their headings [rad], in [0, pi], (n,).")
      .def_property_readonly(
          "qualities",
          [](const Evaluated& self) {
            return column(self, [](const auto& p) { return p.quality; });
          },
          "The claimed probability that the position error is below 0.5 m, (n,).")
      .def_property_readonly(
          "protection_m",
          [](const Evaluated& self) {
            return column(self, [](const auto& p) { return p.protection.metres; });
          },
          "The claimed bounds of the position error [m], (n,).")
      .def_property_readonly("status", &statusOf,
                             "'tracking', 'uncertain' or 'lost' at these times, (n,).");
}

}  // namespace

void bindEvaluation(py::module_& module) {
  PyRun run(module, "EvaluatedRun",
            "A run that was compared with ground truth: evaluate() makes it.");
  bindPoints(run);
  run.def_property_readonly("figures", &figuresOf,
                            "The figures by the names that `ortung eval --json` has for them; NaN "
                            "where there is none.")
      .def_property_readonly("path", &pathOf,
                             "All estimates, also where truth is not known, (m, 4): time [s], x, y "
                             "[m], heading [rad].")
      .def_property_readonly(
          "update_ms", [](const Evaluated& self) { return copyOf(self.run.updateMs); },
          "How long each update took [ms].")
      .def_property_readonly(
          "first_stamp", [](const Evaluated& self) { return self.run.first; },
          "Of the first reading [us].")
      .def_property_readonly(
          "source", [](const Evaluated& self) { return self.run.figures.source; },
          "What was evaluated, as evaluate() was told.")
      .def_property_readonly(
          "robot", [](const Evaluated& self) { return self.robot; }, "The robot's name.")
      .def_property_readonly(
          "world", [](const Evaluated& self) { return self.world; },
          "The name of the tables' world.")
      .def("__repr__", &reprOf);
  module.def(
      "evaluate", &evaluateRun, py::arg("source"), py::arg("robot"), py::arg("tables"),
      py::arg("seed") = 1, py::arg("particles") = py::none(), py::arg("threads") = py::none(),
      py::arg("start") = "global", py::arg("converged_m") = 0.5, py::arg("converged_deg") = 15.0,
      py::arg("progress") = py::none(), py::arg("any_world") = false,
      py::arg("sensors") = py::none(),
      "Localizes a robot by a source with ground truth and compares, as `ortung eval` does. "
      "source: 'KIND:PATH?key=value', e.g. 'record:run.rec'; robot, tables: files. particles, "
      "threads: None for what the robot file says. start: 'global' (it may be anywhere), 'truth' "
      "(at the source's first ground truth) or a pose (x, y, theta) in the field [m, rad]. "
      "converged_m, converged_deg: errors are counted from the time on from which they stay below "
      "these for 5 s. progress: a function that is called now and then with the share of the run "
      "that is done, in [0, 1]; what it raises ends the run, and evaluate() raises it. any_world: "
      "whether the readings may be of another world than the tables. sensors: sensors of one's own "
      "by the names of their features, as add_sensor() takes them, or (sensor, values); the source "
      "has their readings. They can't be ones that learn. ValueError for other starts, "
      "WorldMismatch for another world, RuntimeError if there is nothing to localize with. "
      "Returns an EvaluatedRun.");
}

}  // namespace ortung::python

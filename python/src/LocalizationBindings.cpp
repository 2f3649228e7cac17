// MCL on a robot's readings, and maps of what they say.
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "Bindings.hpp"
#include "FeatureNames.hpp"
#include "OwnSensor.hpp"
#include "Robots.hpp"
#include "Starts.hpp"
#include "ortung/base/Nearest.hpp"
#include "ortung/run/FieldMaps.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::python {
namespace {

/// A localization, and Python's threads at it: one call at a time, while other threads set readings
/// of its container.
struct SharedLocalization {
  std::unique_ptr<Localization> localization;
  bool hasSource = false;
  Gate gate{"this Localization"};
  std::shared_ptr<Gate> containerGate = python::containerGate();
  OpenedHere opened;
  /// The present samples, as views share them; null: not asked for since the belief changed.
  std::shared_ptr<const SampleSet> samples;

  ~SharedLocalization() {
    if (gate.isBroken() || containerGate->isBroken()) leave(localization);
  }
};
using Shared = std::shared_ptr<SharedLocalization>;

/// Calls work(Localization&) alone, without Python's lock. No feature is added meanwhile. What a
/// sensor of Python raised in it is raised here.
template <class Work>
auto visit(SharedLocalization& self, const Work& work) {
  const Gate::Alone alone(self.gate);
  const Gate::Together together(*self.containerGate);
  const auto call = [&] {
    const py::gil_scoped_release others;
    return work(*self.localization);
  };
  if constexpr (std::is_void_v<decltype(call())>) {
    call();
    raiseFailures(self.localization->container());
  } else {
    auto result = call();
    raiseFailures(self.localization->container());
    return result;
  }
}

/// The same of what may change the belief: views of the samples that there were stay as they are.
template <class Work>
auto change(SharedLocalization& self, const Work& work) {
  self.samples.reset();
  return visit(self, work);
}

std::string reprOf(const PoseEstimate& e) {
  char text[120];
  std::snprintf(text, sizeof text, "PoseEstimate(x=%.3f, y=%.3f, theta=%.4f, status='%s')",
                e.pose.x, e.pose.y, e.pose.theta, nameOf(e.status));
  return text;
}

Shared open(const std::filesystem::path& robot, const std::filesystem::path& tables,
            const std::string& source, std::uint64_t seed, std::optional<std::size_t> particles,
            std::optional<unsigned> threads, const py::object& start, bool anyWorld) {
  const LocalizationConfig config =
      configOf(robot, tables, source, seed, particles, threads, start);
  const auto made = std::make_shared<SharedLocalization>();
  made->hasSource = !source.empty();
  const py::gil_scoped_release others;
  made->localization = localizationOf(config, anyWorld);
  return made;
}

/// The samples as they are now: taken once a belief, for all views of it.
std::shared_ptr<const SampleSet> samplesOf(SharedLocalization& self) {
  if (!self.samples)
    self.samples = visit(self, [](Localization& one) {
      return std::make_shared<const SampleSet>(one.mcl().samples());
    });
  return self.samples;
}

py::dict sampleViews(SharedLocalization& self) {
  const std::shared_ptr<const SampleSet> samples = samplesOf(self);
  const auto* const kept = new std::shared_ptr<const SampleSet>(samples);
  const py::capsule owner(
      kept, [](void* one) { delete static_cast<const std::shared_ptr<const SampleSet>*>(one); });
  const auto view = [&](const std::vector<float>& numbers) {
    return readOnly(
        py::array_t<float>(static_cast<py::ssize_t>(numbers.size()), numbers.data(), owner));
  };
  py::dict views;
  views["x"] = view(samples->x);
  views["y"] = view(samples->y);
  views["theta"] = view(samples->theta);
  views["log_weight"] = view(samples->logWeight);
  return views;
}

py::array particlesOf(SharedLocalization& self) {
  const std::shared_ptr<const SampleSet> shared = samplesOf(self);
  const SampleSet& samples = *shared;
  const auto n = static_cast<py::ssize_t>(samples.x.size());
  py::array_t<float> all({n, py::ssize_t{4}});
  auto out = all.mutable_unchecked<2>();
  float most = -std::numeric_limits<float>::infinity();
  for (const float one : samples.logWeight) most = std::max(most, one);
  float sum = 0.0f;
  for (const float one : samples.logWeight) sum += std::exp(one - most);
  for (py::ssize_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out(i, 0) = samples.x[k], out(i, 1) = samples.y[k], out(i, 2) = samples.theta[k];
    out(i, 3) = std::exp(samples.logWeight[k] - most) / sum;
  }
  return all;
}

py::array mapOf(const FieldGrid& grid, const std::vector<double>& values) {
  return copyOf(values).reshape(
      {static_cast<py::ssize_t>(grid.rows), static_cast<py::ssize_t>(grid.columns)});
}

/// What a map is made of: one pattern or several; none: all features that localize.
using Patterns = std::optional<std::variant<std::string, std::vector<std::string>>>;

std::vector<std::string> listOf(const Patterns& patterns) {
  if (const auto* const one = std::get_if<std::string>(&*patterns)) return {*one};
  return std::get<std::vector<std::string>>(*patterns);
}

/// Says which patterns no feature fits that localizes.
[[noreturn]] void refusePatterns(const SensorContainer& container,
                                 const std::vector<std::string>& patterns) {
  if (patterns.empty()) throw py::value_error("features is empty, expected a pattern or None");
  std::string all;
  for (const std::string& one : patterns) all += (all.empty() ? "'" : ", '") + one + "'";
  std::vector<std::string> localizing;
  for (const auto& data : container.all())
    if (data->localizes()) localizing.push_back(toText(data->id()));
  throw py::key_error(
      "no feature that localizes fits " + all +
      (patterns.size() == 1 ? didYouMean(all.substr(1, all.size() - 2), localizing) : "") +
      thereAre(localizing));
}

/// The weighers that a map is made of.
Weighers chosenWeighers(Localization& self, const Patterns& features,
                        std::optional<std::vector<double>>& headings) {
  const SensorContainer::ReadLock lock = self.container().read();
  const std::vector<std::string> patterns =
      features ? listOf(features) : std::vector<std::string>{"*/*/*"};
  std::vector<SensorQuery> queries;
  for (const std::string& one : patterns) queries.push_back(featureQueryOf(one, self.container()));
  std::vector<const SensorData*> chosen;
  for (const auto& data : self.container().all()) {
    const bool isChosen =
        std::any_of(queries.begin(), queries.end(),
                    [&](const SensorQuery& query) { return matches(query, data->id()); });
    if (isChosen && data->localizes()) chosen.push_back(data.get());
  }
  if (features && chosen.empty()) refusePatterns(self.container(), patterns);
  if (!headings) headings = mapHeadings(self.robot().tables.headingStep, chosen);
  return weighersOf(chosen);
}

py::array probability(SharedLocalization& self, const Patterns& features,
                      std::optional<std::vector<double>> headings, bool isLog) {
  const FieldRegion& region = self.localization->robot().tables.region;
  const std::vector<double> values = visit(self, [&](Localization& one) {
    const Weighers weighers = chosenWeighers(one, features, headings);
    return isLog ? logProbabilityMap(region, weighers, *headings)
                 : probabilityMap(region, weighers, *headings);
  });
  return mapOf(region.grid, values);
}

py::array expectation(SharedLocalization& self, const std::string& feature, std::size_t index,
                      double heading) {
  const FieldRegion& region = self.localization->robot().tables.region;
  const std::vector<double> values = visit(self, [&](Localization& one) {
    const SensorContainer::ReadLock lock = one.container().read();
    const SensorData& data = needFeature(one.container(), feature);
    return expectationMap(region, data, index, heading).values;
  });
  return mapOf(region.grid, values);
}

std::string reprOf(SharedLocalization& self) {
  return visit(self, [](Localization& one) {
    const PoseEstimate& e = one.mcl().estimate();
    char text[160];
    std::snprintf(text, sizeof text, ", samples=%zu, x=%.3f, y=%.3f, theta=%.4f, status='%s')",
                  one.mcl().samples().size(), e.pose.x, e.pose.y, e.pose.theta, nameOf(e.status));
    return "Localization('" + one.robot().config.name + "' in '" + one.robot().tables.world + "'" +
           text;
  });
}

std::optional<PoseEstimate> nextEstimate(SharedLocalization& self) {
  if (self.hasSource) self.opened.check("the readings of this Localization");
  return change(self, [](Localization& one) { return one.next(); });
}

void bindEstimate(py::module_& module) {
  py::class_<PoseEstimate>(module, "PoseEstimate", "Where the robot is, in the field frame.")
      .def_readonly("stamp", &PoseEstimate::stamp, "Its time [us].")
      .def_property_readonly(
          "x", [](const PoseEstimate& e) { return e.pose.x; }, "x in the field [m].")
      .def_property_readonly(
          "y", [](const PoseEstimate& e) { return e.pose.y; }, "y in the field [m].")
      .def_property_readonly(
          "theta", [](const PoseEstimate& e) { return e.pose.theta; },
          "Heading [rad], in (-pi, pi].")
      .def_property_readonly(
          "covariance",
          [](const PoseEstimate& e) {
            return copyOf(std::vector<double>(e.covariance.begin(), e.covariance.end()))
                .reshape({3, 3});
          },
          "(3, 3) of x, y, theta, in the field frame [m, rad].")
      .def_property_readonly(
          "status", [](const PoseEstimate& e) { return nameOf(e.status); },
          "'tracking', 'uncertain' or 'lost'.")
      .def_property_readonly(
          "reason", [](const PoseEstimate& e) { return nameOf(e.reason); },
          "Why the status is not better.")
      .def_readonly("quality", &PoseEstimate::quality,
                    "probability that the position error is below 0.5 m")
      .def_property_readonly(
          "protection_m", [](const PoseEstimate& e) { return e.protection.metres; },
          "distance that the position error exceeds in one of 1000 cases while tracking, of 100 "
          "while uncertain; inf: "
          "nothing bounds it")
      .def_property_readonly(
          "protection_rad", [](const PoseEstimate& e) { return e.protection.radians; },
          "the same angle of the heading")
      .def_property_readonly(
          "smooth",
          [](const PoseEstimate& e) { return std::tuple(e.smooth.x, e.smooth.y, e.smooth.theta); },
          "(x, y, theta) without steps, for controllers: corrections are blended in over half a "
          "second")
      .def_readonly("relocalizations", &PoseEstimate::relocalizations,
                    "how often the pose moved by more than 0.10 m or 3 degrees beyond the motion")
      .def_property_readonly(
          "relocalization", [](const PoseEstimate& e) { return nameOf(e.relocalization); },
          "why it did so last")
      .def("__repr__", [](const PoseEstimate& self) { return reprOf(self); });
}

using PyLocalization = py::class_<SharedLocalization, Shared>;

/// The belief as arrays, and maps of what readings say.
void bindArrays(PyLocalization& bound) {
  bound
      .def_property_readonly("particles", &particlesOf,
                             "A copy of the samples, (n, 4): x, y [m], heading [rad], weight; "
                             "weights have the sum 1.")
      .def_property_readonly(
          "samples", &sampleViews,
          "Views of the samples by name: x, y [m], theta [rad], not wrapped, and log_weight, up to "
          "a constant, (n,) each, to be read only. All calls until the belief changes give the "
          "same memory, and views that are kept keep what they show.")
      .def(
          "probability_map", &probability, py::arg("features") = py::none(),
          py::arg("headings") = py::none(), py::arg("log") = false,
          "p(s|l) of the present readings, (rows, columns) from the lower left corner: the best of "
          "the headings [rad] for each cell; NaN where a cell is not open. features: the name of a "
          "feature, a pattern such as '*/LRF/*' ('*' stands for any part), or a list of these; "
          "None: all that localize. headings: None for those that the tables have. With log=True "
          "ln p, also where p is too small for a number. KeyError if no feature that localizes "
          "fits, with those that there are.")
      .def("expectation_map", &expectation, py::arg("feature"), py::arg("index") = 0,
           py::arg("heading") = 0.0, "What a feature expects over the field, [m] or [rad].")
      .def_property_readonly(
          "extent",
          [](const SharedLocalization& self) {
            return extentOf(self.localization->robot().tables.region.grid);
          },
          "x, x, y, y of the maps' edges [m].")
      .def("__repr__", [](SharedLocalization& self) { return reprOf(self); });
}

}  // namespace

void bindLocalization(py::module_& module) {
  bindEstimate(module);
  PyLocalization bound(
      module, "Localization",
      "Where one robot is, by MCL: go through its estimates if it has a source, or set readings of "
      "its container and call update().");
  bound
      .def(py::init(&open), py::arg("robot"), py::arg("tables"), py::arg("source") = "",
           py::arg("seed") = 1, py::arg("particles") = py::none(), py::arg("threads") = py::none(),
           py::arg("start") = "global", py::arg("any_world") = false,
           "Opens a robot file and its tables. source: 'KIND:PATH?key=value', or '' if the program "
           "sets readings; particles, threads: None for what the robot file says; start: 'global', "
           "'truth' (the source's first ground truth) or a pose (x, y, theta) [m, rad]; any_world: "
           "whether the source may be of another world than the tables.")
      .def_property_readonly(
          "container",
          [](const Shared& self) {
            return Container{self, &self->localization->container(), self->containerGate};
          },
          "The features of the robot with their newest readings.")
      .def(
          "update",
          [](SharedLocalization& self) {
            return change(self, [](Localization& one) { return one.update(); });
          },
          "The new estimate if readings have weighed the belief, or None.")
      .def(
          "estimate",
          [](SharedLocalization& self, Timestamp stamp) {
            return visit(self, [&](Localization& one) { return one.estimate(stamp); });
          },
          py::arg("stamp"), "The belief carried on by odometry to a time [us], or None.")
      .def(
          "set_pose",
          [](SharedLocalization& self, double x, double y, double theta, double sigmaPosition,
             double sigmaHeading) {
            const double p = sigmaPosition * sigmaPosition;
            const PoseCovariance covariance{p, 0, 0, 0, p, 0, 0, 0, sigmaHeading * sigmaHeading};
            change(self, [&](Localization& one) { one.setPose({x, y, theta}, covariance); });
          },
          py::arg("x"), py::arg("y"), py::arg("theta"), py::arg("sigma_position") = 0.3,
          py::arg("sigma_heading") = 0.17,
          "Sets the belief to a pose in the field that is known now [m, rad], with standard "
          "deviations; odometry carries it on. ValueError where the robot can't stand.")
      .def(
          "relocalize",
          [](SharedLocalization& self) {
            change(self, [](Localization& one) { one.relocalize(); });
          },
          "Forgets the place: the present readings, or else the next ones, find it anew.")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", [](SharedLocalization& self) {
        const std::optional<PoseEstimate> estimate = nextEstimate(self);
        if (!estimate) throw py::stop_iteration();
        return *estimate;
      });
  bindArrays(bound);
}

}  // namespace ortung::python

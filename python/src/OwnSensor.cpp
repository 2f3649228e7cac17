// Sensors that are written in Python, for trying them out: batches of poses go to them.
#include "OwnSensor.hpp"

#include <bit>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "FeatureNames.hpp"
#include "ortung/base/Nearest.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The object of Python, and what it has raised where nobody could catch it: threads of the filter
/// weigh by it. All calls of it have Python's lock.
class PythonSensor {
 public:
  PythonSensor(std::string feature, const py::object& sensor, std::size_t count)
      : feature_(std::move(feature)), sensor_(sensor), count_(count) {
    if (PyType_Check(sensor.ptr()) != 0)
      throw py::type_error(feature_ + ": the sensor is a class, expected an object of it");
    warnOfMisspelt();
    learns_ = py::hasattr(sensor, "learn");
    readModel();
    if (py::hasattr(sensor, "probability")) return;
    if (!py::hasattr(sensor, "expected") || !py::hasattr(sensor, "sigma"))
      throw py::type_error(feature_ + ": the sensor is " + describe() +
                           ", expected one with expected(poses) and sigma, or with "
                           "probability(reading, poses)");
    hasModel_ = true;
  }
  ~PythonSensor() {
    const PyGILState_STATE python = PyGILState_Ensure();
    sensor_.release().dec_ref();
    failure_ = nullptr;
    PyGILState_Release(python);
  }
  PythonSensor(const PythonSensor&) = delete;
  PythonSensor& operator=(const PythonSensor&) = delete;

  bool learns() const { return learns_; }
  std::size_t count() const { return count_; }

  /// Tells the sensor what it reads at a pose.
  void learn(const Pose2& pose, const std::vector<double>& reading) {
    const py::gil_scoped_acquire python;
    sensor_.attr("learn")(copyOf(std::vector<double>{pose.x, pose.y, pose.theta}), copyOf(reading));
  }
  /// The expectations at poses, (N, count); none if the sensor does not tell them.
  std::optional<Numbers> expected(const SampleView& poses) const {
    if (!hasModel_) return std::nullopt;
    const auto n = static_cast<py::ssize_t>(poses.size());
    const auto width = static_cast<py::ssize_t>(count_);
    Numbers found = answer(sensor_.attr("expected")(tableOfPoses(poses)), "expected()");
    const bool isRow = found.ndim() == 1 && count_ == 1 && found.shape(0) == n;
    if (!isRow && (found.ndim() != 2 || found.shape(0) != n || found.shape(1) != width))
      throw py::value_error(feature_ + ": expected() gave the shape " + shapeOf(found) +
                            ", expected (" + std::to_string(n) + ", " + std::to_string(width) +
                            ")");
    return found;
  }
  /// Adds ln p of the reading at poses. What goes wrong is kept: it must not leave this thread.
  /// Poses that are nowhere (NaN), by which the filter asks for the floor, never get to Python.
  void weigh(const std::vector<double>& reading, const SampleView& all, std::span<float> out) {
    Places places(all);
    const auto numbers = static_cast<double>(hasModel_ ? count_ : 1);
    const auto floor = static_cast<float>(model_.logFloor() * numbers);
    for (const std::size_t nowhere : places.nowhere) out[nowhere] += floor;
    if (places.somewhere.empty()) return;
    const py::gil_scoped_acquire python;
    if (failure_) return;
    std::vector<float> found(places.somewhere.size(), 0.0F);
    weighPlaces(reading, places.view(), found);
    for (std::size_t i = 0; i < found.size(); ++i) out[places.somewhere[i]] += found[i];
  }
  /// Raises what went wrong since the last call.
  void raise() {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  /// Poses by whether they are anywhere.
  struct Places {
    explicit Places(const SampleView& all) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        const bool isThere =
            std::isfinite(all.x[i]) && std::isfinite(all.y[i]) && std::isfinite(all.theta[i]);
        (isThere ? somewhere : nowhere).push_back(i);
        if (!isThere) continue;
        x.push_back(all.x[i]);
        y.push_back(all.y[i]);
        theta.push_back(all.theta[i]);
      }
    }
    SampleView view() const { return {x, y, theta}; }
    std::vector<std::size_t> somewhere;
    std::vector<std::size_t> nowhere;
    std::vector<float> x, y, theta;
  };

  void weighPlaces(const std::vector<double>& reading, const SampleView& poses,
                   std::span<float> out) {
    try {
      if (const auto expectations = expected(poses))
        byModel(reading, *expectations, out);
      else
        byProbability(reading, poses, out);
    } catch (const std::exception&) {
      failure_ = std::current_exception();
    }
  }
  std::string describe() const { return py::cast<std::string>(py::repr(py::type::of(sensor_))); }
  static std::string shapeOf(const py::array& array) { return textOf(array.attr("shape")); }
  Numbers answer(const py::object& numbers, const char* what) const {
    return realNumbers<double>(numbers, feature_ + ": the numbers of " + what);
  }
  static Numbers tableOfPoses(const SampleView& poses) {
    Numbers table({static_cast<py::ssize_t>(poses.size()), py::ssize_t{3}});
    double* out = table.mutable_data();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      *out++ = static_cast<double>(poses.x[i]);
      *out++ = static_cast<double>(poses.y[i]);
      *out++ = static_cast<double>(poses.theta[i]);
    }
    return table;
  }
  /// Warns of an attribute that has nearly the name of one that is asked for and not there: what
  /// may be left out would be ignored silently.
  void warnOfMisspelt() const {
    std::vector<std::string> lacking;
    for (const char* name : {"sigma", "outliers", "is_angle", "learn", "expected", "probability"})
      if (!py::hasattr(sensor_, name)) lacking.emplace_back(name);
    const py::list names = py::module_::import("builtins").attr("dir")(sensor_);
    for (const py::handle one : names) {
      const auto name = py::cast<std::string>(one);
      const std::string meant = name.starts_with('_') ? "" : nearest(name, lacking);
      if (meant.empty()) continue;
      const std::string text =
          feature_ + ": the sensor's '" + name + "' is not used; did you mean '" + meant + "'?";
      if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
    }
  }
  void readModel() {
    if (py::hasattr(sensor_, "sigma"))
      model_.sigma = py::cast<double>(py::float_(sensor_.attr("sigma")));
    if (py::hasattr(sensor_, "outliers"))
      model_.outliers = py::cast<double>(py::float_(sensor_.attr("outliers")));
    isAngle_ = py::hasattr(sensor_, "is_angle") && py::cast<bool>(sensor_.attr("is_angle"));
    if (!(model_.sigma > 0.0) || !std::isfinite(model_.sigma))
      throw py::value_error(feature_ + ": sigma must be positive");
    if (!(model_.outliers > 0.0 && model_.outliers < 1.0))
      throw py::value_error(feature_ + ": outliers must be in (0, 1)");
  }
  void byModel(const std::vector<double>& reading, const Numbers& expectations,
               std::span<float> out) const {
    const double* expected = expectations.data();
    for (float& value : out) {
      double sum = 0.0;
      for (std::size_t k = 0; k < count_; ++k, ++expected) {
        const double off = reading[k] - *expected;
        const double residual = isAngle_ ? std::remainder(off, 2.0 * M_PI) : off;
        if (std::isnan(reading[k])) continue;  // not measured: says nothing
        sum += std::isnan(residual) ? model_.logFloor()
                                    : model_.logProbability(residual / model_.sigma);
      }
      value += static_cast<float>(sum);
    }
  }
  void byProbability(const std::vector<double>& reading, const SampleView& poses,
                     std::span<float> out) const {
    const Numbers found =
        answer(sensor_.attr("probability")(copyOf(reading), tableOfPoses(poses)), "probability()");
    if (found.ndim() != 1 || static_cast<std::size_t>(found.size()) != out.size())
      throw py::value_error(feature_ + ": probability() gave the shape " + shapeOf(found) +
                            ", expected (" + std::to_string(out.size()) + ",)");
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double p = found.data()[i];
      if (!(p >= 0.0 && p <= 1.0))
        throw py::value_error(feature_ + ": probability() gave " + textOf(py::float_(p)) +
                              ", expected 0 to 1");
      out[i] += static_cast<float>(std::log(p));
    }
  }

  std::string feature_;
  py::object sensor_;
  std::size_t count_;
  bool learns_ = false;
  bool hasModel_ = false;
  bool isAngle_ = false;
  SensorModel model_{};
  std::exception_ptr failure_;
};

class OwnWeigher final : public Weigher {
 public:
  OwnWeigher(std::shared_ptr<PythonSensor> sensor, std::vector<double> reading)
      : sensor_(std::move(sensor)), reading_(std::move(reading)) {}

 private:
  void weigh(const SampleView& poses, std::span<float> out) const override {
    sensor_->weigh(reading_, poses, out);
  }

  std::shared_ptr<PythonSensor> sensor_;
  std::vector<double> reading_;
};

/// The feature of such a sensor.
class OwnFeature final : public SensorData {
 public:
  OwnFeature(SensorId id, std::shared_ptr<PythonSensor> sensor)
      : SensorData(std::move(id)), sensor_(std::move(sensor)), reading_(sensor_->count()) {}

  PythonSensor& sensor() const { return *sensor_; }
  const std::vector<double>& reading() const { return reading_; }

  bool localizes() const override { return true; }
  Format format() const override {
    return Format(kNumbers).with("count", static_cast<double>(sensor_->count()));
  }
  std::string wordsHelp() const override {
    return std::to_string(sensor_->count()) + " numbers: the bits of IEEE 754 singles";
  }
  std::vector<double> expectation(const Pose2& pose) const override {
    const py::gil_scoped_acquire python;
    const float x = static_cast<float>(pose.x);
    const float y = static_cast<float>(pose.y);
    const float theta = static_cast<float>(pose.theta);
    const auto found = sensor_->expected({{&x, 1}, {&y, 1}, {&theta, 1}});
    if (!found) return {};
    return {found->data(), found->data() + found->size()};
  }

 private:
  void check(std::span<const std::uint32_t> words) const override {
    if (words.size() != sensor_->count())
      throw std::invalid_argument(toText(id()) + ": " + std::to_string(words.size()) +
                                  " words, expected " + std::to_string(sensor_->count()));
  }
  void decode(std::span<const std::uint32_t> words) override {
    for (std::size_t i = 0; i < words.size(); ++i)
      reading_[i] = static_cast<double>(std::bit_cast<float>(words[i]));
  }
  void startTables(const FieldRegion&, double) override {}
  void learn(const Pose2& robotInField) override {
    if (sensor_->learns()) sensor_->learn(robotInField, reading_);
  }
  void finishTables() override {}
  std::shared_ptr<const Weigher> makeWeigher() const override {
    return std::make_shared<OwnWeigher>(sensor_, reading_);
  }

  std::shared_ptr<PythonSensor> sensor_;
  std::vector<double> reading_;
};

}  // namespace

std::unique_ptr<SensorData> makeOwnSensor(const std::string& feature, const py::object& sensor,
                                          std::size_t count) {
  constexpr std::size_t kMostNumbers = 100'000;
  if (count < 1 || count > kMostNumbers)
    throw py::value_error(feature + ": values is " + std::to_string(count) +
                          ", expected 1 to 100000");
  auto data = std::make_unique<OwnFeature>(featureIdOf(feature),
                                           std::make_shared<PythonSensor>(feature, sensor, count));
  if (!data->sensor().learns()) {  // it knows all from the start
    const FieldRegion nowhere{{0.0, 0.0, 1.0, 1, 1}, {1}, {1}, 0.0};
    data->beginLearning(nowhere, 2.0 * M_PI);
    data->endLearning();
  }
  return data;
}

void raiseFailures(const SensorContainer& container) {
  for (const auto& one : container.all())
    if (const auto* own = dynamic_cast<const OwnFeature*>(one.get())) own->sensor().raise();
}

const std::vector<double>* numbersOf(const SensorData& data) {
  const auto* own = dynamic_cast<const OwnFeature*>(&data);
  return own == nullptr ? nullptr : &own->reading();
}

std::vector<std::uint32_t> wordsOfNumbers(const double* numbers, std::size_t count) {
  std::vector<std::uint32_t> words(count);
  for (std::size_t i = 0; i < count; ++i)
    words[i] = std::bit_cast<std::uint32_t>(static_cast<float>(numbers[i]));
  return words;
}

}  // namespace ortung::python

// Readings in metres and radians, and the words that they are made of.
#include "Values.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "OwnSensor.hpp"
#include "ortung/core/ReadingAs.hpp"
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

constexpr double kMostWord = std::numeric_limits<std::uint32_t>::max();
constexpr double kMostMetres = kMostWord / 1000.0;
constexpr double kMostSigned = kMostMetres / 2.0 - 1.0;
constexpr double kMostRadians = 1e4;  ///< rates too, which words hold up to some 3e5

py::object numbersOf(std::initializer_list<double> numbers) {
  return copyOf(std::vector<double>(numbers));
}

std::string shapeOf(const py::array& array) { return textOf(array.attr("shape")); }

/// Values of a reading, with the feature's name for errors.
class Values {
 public:
  Values(const SensorData& data, const py::handle& values)
      : where_(toText(data.id())), numbers_(realNumbers<double>(values, where_ + ": values")) {}

  std::size_t size() const { return static_cast<std::size_t>(numbers_.size()); }
  double operator[](std::size_t i) const { return numbers_.data()[i]; }

  /// @throws py::value_error unless there are @p count in a row, or a single number where one is
  /// expected
  void need(std::size_t count, const char* what) const {
    const bool isNumber = numbers_.ndim() == 0 && count == 1;
    if (!isNumber && (numbers_.ndim() != 1 || size() != count))
      fail("values of the shape " + shapeOf(numbers_) + ", expected " + std::to_string(count) +
           ": " + what);
  }
  /// Returns the number of rows of @p columns values.
  std::size_t rows(std::size_t columns, const char* what) const {
    const bool fits =
        numbers_.ndim() == 2 && numbers_.shape(1) == static_cast<py::ssize_t>(columns);
    if (!fits && size() > 0)
      fail("values of the shape " + shapeOf(numbers_) + ", expected (n, " +
           std::to_string(columns) + "): " + what);
    return size() / columns;
  }
  /// Whether there is one number, and not NaN: something was seen.
  bool isSeen(const char* what) const {
    if (size() == 0) return false;
    need(1, what);
    return !std::isnan((*this)[0]);
  }

  const double* data() const { return numbers_.data(); }
  double length(std::size_t i) const { return within(i, 0.0, kMostMetres, "metres, not negative"); }
  double place(std::size_t i) const { return within(i, -kMostSigned, kMostSigned, "metres"); }
  double angle(std::size_t i) const { return within(i, -kMostRadians, kMostRadians, "radians"); }
  /// A range that may also be invalid (NaN), or mean that nothing was seen (infinite).
  double range(std::size_t i) const {
    const double value = (*this)[i];
    return std::isnan(value) || value == std::numeric_limits<double>::infinity() ? value
                                                                                 : length(i);
  }
  std::uint32_t identity(std::size_t i) const {
    const double value = within(i, 0.0, kMostWord, "an identity");
    if (value != std::floor(value)) fail(i, "an identity, a whole number");
    return static_cast<std::uint32_t>(value);
  }

 private:
  double within(std::size_t i, double low, double high, const char* what) const {
    if (!((*this)[i] >= low && (*this)[i] <= high)) fail(i, what);
    return (*this)[i];
  }
  [[noreturn]] void fail(std::size_t i, const std::string& expected) const {
    fail("value " + std::to_string(i) + " is " + textOf(py::float_((*this)[i])) + ", expected " +
         expected);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw py::value_error(where_ + ": " + what);
  }

  std::string where_;
  py::array_t<double, py::array::c_style | py::array::forcecast> numbers_;
};

std::vector<std::uint32_t> scanWords(const SensorData& data, const Values& values) {
  const auto config = ScanData::configOf(data.format());
  values.need(static_cast<std::size_t>(config.beams), "a range [m] for each beam");
  std::vector<float> ranges(values.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = static_cast<float>(values.range(i));
  std::vector<std::uint32_t> words;
  ScanData::encode(ranges, config.maxRange, words);
  return words;
}

std::vector<std::uint32_t> odometryWords(const Values& values) {
  values.need(6, "x, y [m], heading [rad], velocities forward, left [m/s] and turn [rad/s]");
  OdometryData::Reading reading;
  reading.pose = {values.place(0), values.place(1), values.angle(2)};
  reading.translationalVelocity = values.place(3);
  reading.lateralVelocity = values.place(4);
  reading.rotationalVelocity = values.angle(5);
  return OdometryData::encode(reading);
}

std::vector<std::uint32_t> landmarksWords(const Values& values) {
  LandmarksData::Reading reading(values.rows(3, "identity, range [m], bearing [rad]"));
  for (std::size_t i = 0; i < reading.size(); ++i)
    reading[i] = {values.identity(3 * i), values.length(3 * i + 1), values.angle(3 * i + 2)};
  return LandmarksData::encode(reading);
}

std::vector<std::uint32_t> pointsWords(const Values& values) {
  PointsData::Reading reading(values.rows(2, "range [m], bearing [rad]"));
  for (std::size_t i = 0; i < reading.size(); ++i)
    reading[i] = {values.length(2 * i), values.angle(2 * i + 1)};
  return PointsData::encode(reading);
}

std::vector<std::uint32_t> objectsWords(const Values& values) {
  ObjectsData::Reading reading(values.rows(3, "range [m], bearing [rad], radius [m]"));
  for (std::size_t i = 0; i < reading.size(); ++i) {
    reading[i].range = values.length(3 * i);
    reading[i].bearing = values.angle(3 * i + 1);
    reading[i].radius = values.length(3 * i + 2);
  }
  return ObjectsData::encode(reading);
}

template <class List, class Row>
py::object table(const List& list, py::ssize_t columns, const Row& row) {
  return tableOf(static_cast<py::ssize_t>(list.size()), columns,
                 [&](py::ssize_t i) { return row(list[static_cast<std::size_t>(i)]); });
}

}  // namespace

py::object readingOf(const SensorData& data) {
  if (data.sequence() == 0) return py::none();
  if (const std::vector<double>* numbers = numbersOf(data)) return copyOf(*numbers);
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

std::vector<std::uint32_t> encode(const SensorData& data, const py::handle& given) {
  const std::string name = data.format().name();
  const Values values(data, given);
  if (name == ScanData::kFormat) return scanWords(data, values);
  if (name == OdometryData::kFormat) return odometryWords(values);
  if (name == LandmarksData::kFormat) return landmarksWords(values);
  if (name == PointsData::kFormat) return pointsWords(values);
  if (name == ObjectsData::kFormat) return objectsWords(values);
  if (name == PoseData::kFormat) {
    values.need(3, "x, y [m], heading [rad]");
    return PoseData::encode({values.place(0), values.place(1), values.angle(2)});
  }
  if (name == ScalarData::kFormat) {
    if (!values.isSeen("a distance [m], or none: nothing was seen")) return {};
    return ScalarData::encode(values.length(0));
  }
  if (name == BearingData::kFormat) {
    if (!values.isSeen("a bearing [rad], or none: nothing was seen")) return {};
    return BearingData::encode(values.angle(0));
  }
  if (name == ConeData::kFormat) {
    values.need(1, "a range [m]");
    return {ConeData::encode(values.range(0), ConeData::configOf(data.format()).maxRange)};
  }
  if (const std::vector<double>* numbers = numbersOf(data)) {
    values.need(numbers->size(), "the numbers of the sensor");
    return wordsOfNumbers(values.data(), values.size());
  }
  throw py::value_error(toText(data.id()) + ": readings of the format " + name +
                        " are no numbers in metres and radians; set() takes its words, see help()");
}

std::vector<std::uint32_t> wordsOf(const py::handle& words, const std::string& where) {
  constexpr const char* kExpected =
      "expected uint32: words are what help() says; set_values() and learn_values() take metres "
      "and radians";
  if (py::isinstance<py::array>(words)) {
    const auto array = py::reinterpret_borrow<py::array>(words);
    const bool isWords = array.dtype().kind() == 'u' && array.itemsize() == sizeof(std::uint32_t);
    if (!isWords && array.size() > 0)
      throw py::type_error(where + ": words are of " + textOf(array.dtype()) + ", " + kExpected);
    if (array.ndim() != 1)
      throw py::value_error(where + ": words of the shape " + shapeOf(array) +
                            ", expected one dimension");
    const auto numbers =
        py::cast<py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>>(array);
    return {numbers.data(), numbers.data() + numbers.size()};
  }
  std::vector<std::uint32_t> all;
  for (const py::handle one : py::iter(words)) {
    if (PyIndex_Check(one.ptr()) == 0 || py::isinstance<py::bool_>(one))
      throw py::type_error(where + ": word " + std::to_string(all.size()) + " is " +
                           py::cast<std::string>(py::repr(one)) + ", " + kExpected);
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(one.ptr()));
    if (!number) throw py::error_already_set();
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
    if (overflow != 0 || value < 0 || value > std::numeric_limits<std::uint32_t>::max())
      throw py::value_error(where + ": word " + std::to_string(all.size()) + " is " +
                            py::cast<std::string>(py::repr(one)) + ", " + kExpected);
    all.push_back(static_cast<std::uint32_t>(value));
  }
  return all;
}

}  // namespace ortung::python

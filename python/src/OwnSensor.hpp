#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "Bindings.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung::python {

/// Format of the readings of sensors that are written in Python: numbers as they are.
inline constexpr const char* kNumbers = "numbers";

/// Makes the feature of a sensor that is written in Python, see SensorContainer.add_sensor().
/// @param sensor has `expected(poses)` and `sigma`, or `probability(reading, poses)`
/// @param count numbers of a reading, at least 1
/// @throws py::type_error, py::value_error for a sensor without these, or with impossible ones
std::unique_ptr<SensorData> makeOwnSensor(const std::string& feature, const py::object& sensor,
                                          std::size_t count);

/// Raises what a sensor of the container has raised while other threads weighed by it. The caller
/// holds Python's lock.
void raiseFailures(const SensorContainer& container);

/// The present numbers of such a feature; null if it is none.
const std::vector<double>* numbersOf(const SensorData& data);

/// The words of a reading of such a feature, whose count is right.
std::vector<std::uint32_t> wordsOfNumbers(const double* numbers, std::size_t count);

}  // namespace ortung::python

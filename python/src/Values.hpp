#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Bindings.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung::python {

/// The newest reading in metres and radians, by the name of its format; one of a plugin's own gives
/// its words.
py::object readingOf(const SensorData& data);

/// The words of a reading in metres and radians, the inverse of readingOf().
/// @throws py::value_error for numbers that no reading of the feature can have, and for a format
///   whose readings are not made of such numbers
std::vector<std::uint32_t> encode(const SensorData& data, const py::handle& values);

/// Words as they are: an array of uint32, or whole numbers of Python. Nothing is converted.
/// @param where the feature @throws py::type_error, py::value_error
std::vector<std::uint32_t> wordsOf(const py::handle& words, const std::string& where);

}  // namespace ortung::python

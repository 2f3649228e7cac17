#pragma once

#include <string>
#include <vector>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung::python {

/// Names of all features of a container, in its order.
std::vector<std::string> namesOf(const SensorContainer& container);

/// "; there are a/b/c, ..." or "; there is none".
std::string thereAre(const std::vector<std::string>& names);

/// Parses a name that Python gave, with what was found in the error.
/// @param container whose features the error lists, or null @throws py::value_error
SensorId featureIdOf(const std::string& name, const SensorContainer* container = nullptr);

/// Parses a query, in which '*' stands for any. @throws py::value_error
SensorQuery featureQueryOf(const std::string& text, const SensorContainer& container);

/// Returns the first feature of a query.
/// @throws py::value_error, py::key_error, both with the features that there are
SensorData& needFeature(SensorContainer& container, const std::string& query);

}  // namespace ortung::python

// Features by the names that Python gives, and what is wrong with a name.
#include "FeatureNames.hpp"

#include <stdexcept>

#include "Bindings.hpp"
#include "ortung/base/Nearest.hpp"

namespace ortung::python {
namespace {

/// Calls parse(), with what was found and the features that there are in its error.
template <class Parse>
auto told(const std::string& found, const SensorContainer* container, const Parse& parse) {
  try {
    return parse();
  } catch (const std::invalid_argument& error) {
    throw py::value_error(found + error.what() +
                          (container != nullptr ? thereAre(namesOf(*container)) : ""));
  }
}

}  // namespace

std::vector<std::string> namesOf(const SensorContainer& container) {
  std::vector<std::string> names;
  for (const auto& one : container.all()) names.push_back(toText(one->id()));
  return names;
}

std::string thereAre(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return "; there " + (all.empty() ? "is none" : "are " + all);
}

SensorId featureIdOf(const std::string& name, const SensorContainer* container) {
  return told("found '" + name + "': ", container, [&] { return parseSensorId(name); });
}

SensorQuery featureQueryOf(const std::string& text, const SensorContainer& container) {
  return told("", &container, [&] { return parseSensorQuery(text); });
}

SensorData& needFeature(SensorContainer& container, const std::string& query) {
  SensorData* found = container.find(featureQueryOf(query, container));
  if (found != nullptr) return *found;
  const std::vector<std::string> names = namesOf(container);
  throw py::key_error("there is no feature " + query + didYouMean(query, names) + thereAre(names));
}

}  // namespace ortung::python

#pragma once

#include <vector>

#include "ortung/base/Time.hpp"

namespace ortung::app {

/// The longest time [s] between two moments of a series over which a line is drawn: five times the
/// usual step, at least 1 s. Over longer ones nothing is known, and lines break.
double longestDrawnStep(std::vector<Timestamp> stamps);

/// The same of anything with stamps.
template <class Element>
double longestDrawnStepOf(const std::vector<Element>& elements) {
  std::vector<Timestamp> stamps;
  for (const Element& element : elements) stamps.push_back(element.stamp);
  return longestDrawnStep(std::move(stamps));
}

}  // namespace ortung::app

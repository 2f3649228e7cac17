#pragma once

#include <vector>

#include "ortung/base/Time.hpp"

namespace ortung::app {

/// Returns the longest time [s] between two points of a series over which a line is drawn: five
/// times the usual step, at least 1 s. Lines are broken at longer gaps.
double longestDrawnStep(std::vector<Timestamp> stamps);

/// Returns the same for elements with stamps.
template <class Element>
double longestDrawnStepOf(const std::vector<Element>& elements) {
  std::vector<Timestamp> stamps;
  for (const Element& element : elements) stamps.push_back(element.stamp);
  return longestDrawnStep(std::move(stamps));
}

}  // namespace ortung::app

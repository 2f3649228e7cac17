#pragma once

#include <map>
#include <string>
#include <utility>

#include "CloudShape.hpp"

namespace ortung::ros2 {

/// What is taken of the clouds of each lidar: the bands of heights may be their own.
struct CloudBands {
  CloudBand each;                                            ///< of all that have none of their own
  std::map<std::string, std::pair<double, double>> heights;  ///< least and greatest [m], by topic

  /// Takes the heights of a text: "LOW,HIGH" for all, "TOPIC:LOW,HIGH" for one, with ';' between
  /// several.
  /// @throws std::invalid_argument saying what was found and expected
  void takeHeights(const std::string& text);
  CloudBand of(const std::string& topic) const;
  /// @throws std::invalid_argument as CloudBand::check() of any of them
  void check() const;
};

}  // namespace ortung::ros2

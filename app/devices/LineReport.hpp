#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ortung/calibration/LineCalibration.hpp"

namespace ortung::app {

/// A calibration by lines, and what it is of.
struct LineResult {
  LineCalibration calibration;
  std::string world;  ///< file of the world whose lines fit best
  std::vector<std::filesystem::path> pictures;
  std::vector<std::size_t> points;  ///< number of line points that were found in each picture
};

/// Formats a table of the checks of a verdict, and its sentence.
std::string toText(const Verdict& verdict);
/// Formats a table of the pictures, one of the settings, and one of the checks of the verdict.
std::string toText(const LineResult& result, bool namesWorld);
/// Formats the verdict, the settings with their covariance, and the pictures as JSON.
std::string toJson(const LineResult& result);

}  // namespace ortung::app

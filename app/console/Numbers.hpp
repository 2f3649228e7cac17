#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ortung::app {

/// Parses finite numbers separated by commas, e.g. "1,2.5,90".
/// @param option name of the option for errors, e.g. "--start"
/// @param names names of the numbers, e.g. {"x", "y", "theta_deg"}; there must be as many numbers
/// @throws UsageError
std::vector<double> parseNumbers(const std::string& text, const std::string& option,
                                 const std::vector<std::string>& names);

}  // namespace ortung::app

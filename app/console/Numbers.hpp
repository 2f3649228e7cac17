#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ortung::app {

/// Reads finite numbers separated by commas, e.g. "1,2.5,90".
/// @param option what errors call it, e.g. "--start"
/// @param names of the numbers, e.g. {"x", "y", "theta_deg"}; as many must be there
/// @throws UsageError
std::vector<double> parseNumbers(const std::string& text, const std::string& option,
                                 const std::vector<std::string>& names);

}  // namespace ortung::app

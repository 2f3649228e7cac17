#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// Reads finite decimal numbers with @p separator between them; returns nothing for anything else.
ORTUNG_API std::optional<std::vector<double>> parseNumbers(std::string_view text,
                                                           char separator = ',');

// The options of a source (behind the "?" of its text) come as text.

/// Returns a number, or nothing where the option is not given. @throws ConfigError naming the
/// option
ORTUNG_API std::optional<double> optionNumber(const Parameters& options, const std::string& key,
                                              const Range& range);
ORTUNG_API double optionNumber(const Parameters& options, const std::string& key, double fallback,
                               const Range& range);
/// Returns the pose of "x,y,theta" in metres and degrees, or nothing where the option is not given.
/// @throws ConfigError
ORTUNG_API std::optional<Pose2> optionPose(const Parameters& options, const std::string& key);

}  // namespace ortung

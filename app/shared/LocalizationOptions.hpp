#pragma once

#include "LocalizationArguments.hpp"
#include "OptionBuilder.hpp"
#include "ViewArguments.hpp"

namespace ortung::app {

// Options that commands that localize have in common.

enum class Localizes { kAlways, kIfAsked };

/// Adds robot, tables and settings of MCL. @param when whether robot and tables are required
void addLocalization(Builder& build, LocalizationArguments& a, Localizes when);
/// Adds the runs that a viewer shows.
void addRuns(Builder& build, ViewArguments& a);

}  // namespace ortung::app

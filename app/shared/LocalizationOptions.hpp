#pragma once

#include "LocalizationArguments.hpp"
#include "ViewArguments.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {

// What commands that localize have in common.

enum class Localizes { kAlways, kIfAsked };

/// Robot, tables and how MCL goes about it. @param when whether robot and tables have to be named
void addLocalization(Builder& build, LocalizationArguments& a, Localizes when);
/// Which runs a viewer shows.
void addRuns(Builder& build, ViewArguments& a);

}  // namespace ortung::app

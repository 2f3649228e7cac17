#pragma once

#include "OptionBuilder.hpp"
#include "ServingArguments.hpp"

namespace ortung::app {

// Options that commands that serve clients have in common.

/// Adds who is admitted, and the page for browsers.
void addDoor(Builder& build, ServingArguments& a);
/// Adds the folder for records that clients begin and end.
void addRecording(Builder& build, ServingArguments& a);
/// Adds who is admitted, and the pace of time.
void addServing(Builder& build, ServingArguments& a);

}  // namespace ortung::app

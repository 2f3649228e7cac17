#pragma once

#include "ServingArguments.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {

// What subcommands that serve something have in common.

/// Who is let in, and the page for browsers.
void addDoor(Builder& build, ServingArguments& a);
/// Where records go that clients begin and end.
void addRecording(Builder& build, ServingArguments& a);
/// Who is let in, and how time passes.
void addServing(Builder& build, ServingArguments& a);

}  // namespace ortung::app

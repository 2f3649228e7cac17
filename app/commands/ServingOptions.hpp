#pragma once

#include "Commands.hpp"

namespace ortung::app {

class Builder;

// What subcommands that serve something have in common.

/// Who is let in, and the page for browsers.
void addDoor(Builder& build, ServingArguments& a);
/// That, and how time passes.
void addServing(Builder& build, ServingArguments& a);

}  // namespace ortung::app

#pragma once

#include "Commands.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung::app {

/// Serves @p world to clients until a signal comes. Says on stdout where it listens.
/// @throws UsageError, std::runtime_error
void serve(ServedWorld& world, const ServingArguments& arguments);

}  // namespace ortung::app

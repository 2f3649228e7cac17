#pragma once

#include <filesystem>

#include "ServingArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung serve`.
struct ServeArguments {
  std::filesystem::path record;
  bool repeats = false;
  ServingArguments serving;
};
int runServe(const ServeArguments& arguments);

}  // namespace ortung::app

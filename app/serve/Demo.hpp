#pragma once

#include "ServingArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung demo`.
struct DemoArguments {
  bool once = false;  ///< whether to run, without a page, only until the robot is localized
  ServingArguments serving;
};
int runDemo(const DemoArguments& arguments);

}  // namespace ortung::app

#pragma once

#include "ServingArguments.hpp"

namespace ortung::app {

struct DemoArguments {
  bool once = false;  ///< without a page, until the robot has found its place
  ServingArguments serving;
};
int runDemo(const DemoArguments& arguments);

}  // namespace ortung::app

#pragma once

#include "ViewArguments.hpp"

namespace ortung::app {

int runView(const ViewArguments& arguments);

}  // namespace ortung::app

#pragma once

#include "ortung/base/Words.hpp"  // where plugins look for it; features of any format have them

#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung {

/// What it takes to ask a reading for a pose, about [ns]: a constant of its own.
ORTUNG_API double nominalNanoseconds(const Weigher& reading);

}  // namespace ortung

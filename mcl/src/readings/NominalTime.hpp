#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung {

/// Returns the approximate time to weigh one pose by a reading [ns]: a constant that its weigher
/// reports, not a measurement.
ORTUNG_API double nominalNanoseconds(const Weigher& reading);

}  // namespace ortung

#pragma once

#include "ortung/base/Export.hpp"

namespace ortung {

/// The processor time that the calling thread has used since it began [s].
ORTUNG_API double processorTime();

}  // namespace ortung

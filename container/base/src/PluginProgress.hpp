#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Says, from within a call of a plugin, that a long piece of work goes on: a PluginWatch counts
/// anew. For loops whose length depends on the user's data and that end in any case. It does not
/// know the caller, so calls of other plugins that are under way are counted anew, too.
/// Thread-safe.
ORTUNG_API void notePluginProgress();
/// How often that was said in this process. Thread-safe.
ORTUNG_API std::uint64_t pluginProgress();

}  // namespace ortung

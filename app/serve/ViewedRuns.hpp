#pragma once

#include <optional>

#include "ScratchFolder.hpp"
#include "ViewArguments.hpp"
#include "ortung/mcl_served/PerceivedPlayback.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::app {

/// Records and sources as the viewer shows them.
struct ViewedRuns {
  ServedPlayback::Config playback;
  /// What weighs their readings; nothing where neither tables nor robot and world are known.
  std::optional<PerceivedPlayback::Config> perception;
};

/// Prepares records and sources for the viewer: localizes them if there are tables, and finds their
/// field: that of --world, of the tables, or of the shipped world in which they were recorded.
/// @param scratch folder for the results; must live as long as the viewer
/// @throws UsageError; else as ortung::Localization and RecordWriter
ViewedRuns prepareRuns(const ViewArguments& arguments, const ScratchFolder& scratch);

}  // namespace ortung::app

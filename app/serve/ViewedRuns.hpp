#pragma once

#include "ScratchFolder.hpp"
#include "ViewArguments.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::app {

/// Prepares records and sources for the viewer: localizes them if there are tables, and finds their
/// field.
/// @param scratch folder for the results; must live as long as the viewer
/// @throws UsageError; else as ortung::Localization and RecordWriter
ServedPlayback::Config prepareRuns(const ViewArguments& arguments, const ScratchFolder& scratch);

}  // namespace ortung::app

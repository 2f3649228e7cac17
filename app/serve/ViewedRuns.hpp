#pragma once

#include "ViewArguments.hpp"
#include "ScratchFolder.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::app {

/// The records and sources that are to be looked at, localized if there are tables, and their
/// field.
/// @param scratch for what is made of them; must last as long as they are looked at
/// @throws UsageError; else as ortung::Localization and RecordWriter
ServedPlayback::Config prepareRuns(const ViewArguments& arguments, const ScratchFolder& scratch);

}  // namespace ortung::app

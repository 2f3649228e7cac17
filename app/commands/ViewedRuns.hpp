#pragma once

#include <filesystem>

#include "Commands.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::app {

/// A folder for what exists as long as it is looked at.
class Workbench {
 public:
  Workbench();   ///< @throws std::runtime_error if there is no room for it
  ~Workbench();  ///< removes what is in it
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;
  std::filesystem::path file(std::size_t number) const;

 private:
  std::filesystem::path path_;
};

/// The records and sources that are to be looked at, localized if there are tables, and their
/// field.
/// @throws UsageError; else as ortung::Localization and RecordWriter
ServedPlayback::Config prepareRuns(const ViewArguments& arguments, const Workbench& bench);

}  // namespace ortung::app

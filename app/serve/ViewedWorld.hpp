#pragma once

#include <memory>
#include <vector>

#include "ScratchFolder.hpp"
#include "ViewArguments.hpp"
#include "ortung/mcl_served/PerceivedPlayback.hpp"
#include "ortung/server/BoardCommand.hpp"
#include "ortung/server/ServedPlayback.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung::app {

/// Records and sources, read and prepared so that they can be served. Not thread-safe.
class ViewedWorld {
 public:
  /// Prepares them: prints progress, and ends at a signal.
  /// @throws as prepareRuns() and ServedPlayback
  explicit ViewedWorld(const ViewArguments& arguments);
  ViewedWorld(const ViewedWorld&) = delete;
  ViewedWorld& operator=(const ViewedWorld&) = delete;

  ServedWorld& world();
  /// Commands of its clients; they must not outlive it.
  std::vector<BoardCommand> commands();

 private:
  ScratchFolder scratch_;
  std::unique_ptr<ServedPlayback> playback_;
  std::unique_ptr<PerceivedPlayback> perceived_;
};

}  // namespace ortung::app

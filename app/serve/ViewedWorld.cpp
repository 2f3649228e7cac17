#include "ViewedWorld.hpp"

#include "Interrupt.hpp"
#include "Progress.hpp"
#include "ViewedRuns.hpp"
#include "ortung/mcl_served/LocalizationCommands.hpp"

namespace ortung::app {

ViewedWorld::ViewedWorld(const ViewArguments& arguments) {
  const ViewedRuns runs = prepareRuns(arguments, scratch_);
  Progress progress("reading", arguments.localization.progress);
  playback_ = std::make_unique<ServedPlayback>(runs.playback, [&](double done) {
    progress.update(done);
    return interruptSignal() == 0;
  });
  if (runs.perception)
    perceived_ = std::make_unique<PerceivedPlayback>(*playback_, *runs.perception);
}

ServedWorld& ViewedWorld::world() {
  if (perceived_) return *perceived_;
  return *playback_;
}

std::vector<BoardCommand> ViewedWorld::commands() {
  std::vector<BoardCommand> commands = playbackCommands(*playback_);
  if (perceived_)
    for (BoardCommand& command : perceptionCommands(*perceived_))
      commands.push_back(std::move(command));
  return commands;
}

}  // namespace ortung::app

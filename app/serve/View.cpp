#include "View.hpp"

#include <utility>
#include <vector>

#include "Interrupt.hpp"
#include "Progress.hpp"
#include "Serving.hpp"
#include "ServingArguments.hpp"
#include "ViewArguments.hpp"
#include "ViewedRuns.hpp"
#include "ortung/mcl_served/LocalizationCommands.hpp"
#include "ortung/mcl_served/PerceivedPlayback.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::app {

int runView(const ViewArguments& arguments) {
  const ScratchFolder scratch;
  const ViewedRuns runs = prepareRuns(arguments, scratch);
  Progress progress("reading", arguments.localization.progress);
  ServedPlayback playback(runs.playback, [&](double done) {
    progress.update(done);
    return interruptSignal() == 0;
  });
  ServingArguments serving = arguments.serving;
  serving.isViewing = true;
  std::vector<BoardCommand> commands = playbackCommands(playback);
  if (!runs.perception) {
    serve(playback, serving, std::move(commands));
    return 0;
  }
  PerceivedPlayback perceived(playback, *runs.perception);
  for (BoardCommand& command : perceptionCommands(perceived))
    commands.push_back(std::move(command));
  serve(perceived, serving, std::move(commands));
  return 0;
}

}  // namespace ortung::app

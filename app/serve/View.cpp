#include "View.hpp"

#include "Interrupt.hpp"
#include "Progress.hpp"
#include "Serving.hpp"
#include "ServingArguments.hpp"
#include "ViewArguments.hpp"
#include "ViewedRuns.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::app {

int runView(const ViewArguments& arguments) {
  const ScratchFolder scratch;
  const ServedPlayback::Config config = prepareRuns(arguments, scratch);
  Progress progress("reading", arguments.localization.progress);
  ServedPlayback playback(config, [&](double done) {
    progress.update(done);
    return interruptSignal() == 0;
  });
  ServingArguments serving = arguments.serving;
  serving.isViewing = true;
  serve(playback, serving, playbackCommands(playback));
  return 0;
}

}  // namespace ortung::app

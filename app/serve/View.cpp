#include "View.hpp"

#include <memory>

#include "DroppedFiles.hpp"
#include "Interrupt.hpp"
#include "Serving.hpp"
#include "ViewedWorld.hpp"

namespace ortung::app {

int runView(const ViewArguments& arguments) {
  auto shown = std::make_unique<ViewedWorld>(arguments);
  DroppedFiles dropped(arguments);
  ServingArguments serving = arguments.serving;
  serving.isViewing = true;
  Serving board(serving, dropped.uploads());
  while (shown) {
    board.run(shown->world(), shown->commands(), [&] { return !dropped.isReady(); });
    shown = interruptSignal() == 0 ? dropped.take() : nullptr;
  }
  return 0;
}

}  // namespace ortung::app

#include "CommandModule.hpp"
#include "Doctor.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addDoctor(Builder& build) {
  const auto a = build.command<DoctorArguments>("doctor", "ortung doctor", runDoctor);
  build.option("--port", a->port, "Port at which servers are to listen")
      .within(1, 65535)
      .showsDefault();
  build.option("--timeout", a->timeout, "Longest time to load a plugin [s]")
      .within(0.1, 3600.0)
      .showsDefault();
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addDoctor)

#include "CommandModule.hpp"

// A command of another version, of which nothing else must be used; without COMMAND_VERSION no
// command at all.
#ifdef COMMAND_VERSION
extern "C" __attribute__((visibility("default"))) ortung::app::CommandModule
ortung_command_module() {
  return {COMMAND_VERSION, nullptr, nullptr};
}
#endif

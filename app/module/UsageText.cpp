#include "UsageText.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "Console.hpp"

namespace ortung::app {

int printUsage(const CLI::App& app, const CLI::ParseError& error) {
  constexpr int kWrongUsage = 2;
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  std::string name = "ortung";
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    name += " " + at->get_name();
  }
  setCommandName(name);
  fail(std::string(error.what()) + "; see `" + name + " --help`");
  return kWrongUsage;
}

}  // namespace ortung::app

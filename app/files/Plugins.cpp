#include "Plugins.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "Console.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung::app {
namespace {

constexpr std::size_t kMostBytes = 1u << 20;  // greatest size of a library's offer

/// Returns the kind of an interface: that of "ortung.Source/0.2.0-3f2a" is "Source".
std::string kindOf(const std::string& interface) {
  const std::size_t begin = interface.starts_with("ortung.") ? 7 : 0;
  return interface.substr(begin, interface.find('/', begin) - begin);
}

/// What a library offers, and the help of its players by lines.
struct Offer {
  PluginFactory::Found found;
  std::map<std::string, std::vector<std::string>> help;  ///< lines of help by player
};

void print(const Offer& offer) {
  const PluginFactory::Found& found = offer.found;
  if (!found.error.empty()) {
    fmt::print("{}\n  BROKEN: {}\n", printable(found.file.string()), printable(found.error));
    return;
  }
  fmt::print("{}\n  library {}, version {}\n", printable(found.file.string()),
             printable(found.library), printable(found.version));
  for (const auto& entry : found.entries) {
    if (entry.interface == PlayerHelp::kInterface) continue;
    fmt::print("  {:<12} {}\n", printable(kindOf(entry.interface)), printable(entry.name));
    const auto help = offer.help.find(entry.name);
    if (entry.interface != Player::kInterface || help == offer.help.end()) continue;
    for (const std::string& line : help->second) fmt::print("    {}\n", printable(line));
  }
}

std::string toText(const Offer& offer) {
  const PluginFactory::Found& found = offer.found;
  auto entries = nlohmann::json::array();
  for (const auto& entry : found.entries) entries.push_back({entry.interface, entry.name});
  const nlohmann::json json = {{"library", found.library},
                               {"version", found.version},
                               {"error", found.error},
                               {"entries", entries},
                               {"help", offer.help}};
  return json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

/// @throws nlohmann::json::exception
Offer fromText(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  Offer offer;
  PluginFactory::Found& found = offer.found;
  found.library = json.at("library");
  found.version = json.at("version");
  found.error = json.at("error");
  for (const auto& entry : json.at("entries")) found.entries.push_back({entry.at(0), entry.at(1)});
  json.at("help").get_to(offer.help);
  return offer;
}

// --- in the child process

/// Writes what was found and ends the process without the library's destructors.
[[noreturn]] void tell(int out, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(out, text.data() + done, text.size() - done);
    if (count < 0) ::_exit(1);
    done += static_cast<std::size_t>(count);
  }
  ::_exit(0);
}

Offer lookInside(const std::filesystem::path& library) {
  PluginFactory factory;
  Offer offer{factory.look(library), {}};
  for (const auto& entry : offer.found.entries) {
    if (entry.interface != PlayerHelp::kInterface) continue;
    std::vector<std::string>& lines = offer.help[entry.name];
    try {
      const auto help = factory.make<PlayerHelp>(entry.name, Parameters());
      lines.push_back(help->what());
      for (const PlayerOption& option : help->options())
        lines.push_back(fmt::format(
            "{}{}: {}{}", option.key, option.unit.empty() ? "" : " [" + option.unit + "]",
            option.meaning, option.fallback.empty() ? "" : "; default: " + option.fallback));
    } catch (const std::exception& error) {
      lines = {std::string("does not describe itself: ") + error.what()};
    }
  }
  return offer;
}

/// Loads a library in this process and writes its offer to standard output, to which the library's
/// code can't write. Loading may hang, so a thread watches it.
[[noreturn]] void describe(const std::filesystem::path& library, double timeout) {
  const int out = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (out < 0 || nothing < 0 || ::dup2(nothing, STDOUT_FILENO) < 0)
    throw std::runtime_error(std::string("no output: ") + std::strerror(errno));
  Offer late;
  late.found.error = fmt::format("was not loaded within {:g} s", timeout);
  std::thread([out, timeout, text = toText(late)] {
    std::this_thread::sleep_for(std::chrono::duration<double>(timeout));
    tell(out, text);
  }).detach();
  tell(out, toText(lookInside(library)));
}

// --- in the parent process

/// Returns what a library offers, whatever its code does when it is loaded.
Offer look(const std::filesystem::path& library, double timeout) {
  Offer offer;
  PluginFactory::Found& found = offer.found;
  try {
    offer = fromText(runHelper(
        std::filesystem::read_symlink("/proc/self/exe"),
        {"plugins", "--inside", library.string(), "--timeout", fmt::format("{}", timeout)},
        library.string(), kMostBytes));
  } catch (const nlohmann::json::exception&) {
    found.error = "ended the process that loaded it";
  } catch (const std::runtime_error& error) {
    found.error = error.what();
  }
  found.file = library;
  return offer;
}

}  // namespace

int runPlugins(const PluginsArguments& arguments) {
  if (!arguments.inside.empty()) describe(arguments.inside, arguments.timeout);
  const std::vector<std::filesystem::path> folders = PluginFactory::standardFolders();
  std::size_t broken = 0, count = 0;
  for (const auto& library : PluginFactory(folders).libraries()) {
    const Offer offer = look(library, arguments.timeout);
    print(offer);
    ++count;
    if (!offer.found.error.empty()) ++broken;
  }
  fmt::print("{} libraries, {} broken; searched in", count, broken);
  for (const auto& folder : folders) fmt::print(" {}", printable(folder.string()));
  fmt::print("\n  Source       record (built in)\n");
  return broken == 0 ? 0 : 1;
}

}  // namespace ortung::app

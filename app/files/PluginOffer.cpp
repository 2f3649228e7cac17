#include "PluginOffer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "ortung/base/HelperProgram.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung::app {
namespace {

constexpr std::size_t kMostBytes = 1u << 20;  // greatest size of a library's offer

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

/// Returns a help's first line, what the plugin is, and a line for each of its options.
template <class Options>
std::vector<std::string> linesOf(const std::string& what, const Options& options) {
  std::vector<std::string> lines = {what};
  for (const auto& option : options)
    lines.push_back(fmt::format("{}{}: {}{}", option.key,
                                option.unit.empty() ? "" : " [" + option.unit + "]", option.meaning,
                                option.fallback.empty() ? "" : "; default: " + option.fallback));
  return lines;
}

Offer lookInside(const std::filesystem::path& library) {
  PluginFactory factory;
  Offer offer{factory.look(library), {}};
  for (const auto& [interface, name] : offer.found.entries) {
    try {
      if (interface == PlayerHelp::kInterface) {
        const auto help = factory.make<PlayerHelp>(name, Parameters());
        offer.help[name] = linesOf(help->what(), help->options());
      } else if (interface == SourceHelp::kInterface) {
        const auto help = factory.make<SourceHelp>(name, Parameters());
        offer.help[name] = linesOf(help->path(), help->options());
      }
    } catch (const std::exception& error) {
      offer.help[name] = {std::string("does not describe itself: ") + error.what()};
    }
  }
  return offer;
}

}  // namespace

void describeOffer(const std::filesystem::path& library, double timeout) {
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

std::string kindOf(const std::string& interface) {
  const std::size_t begin = interface.starts_with("ortung.") ? 7 : 0;
  return interface.substr(begin, interface.find('/', begin) - begin);
}

Offer lookAt(const std::filesystem::path& library, double timeout) {
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

}  // namespace ortung::app

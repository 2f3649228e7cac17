#include "Doctor.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "Catalogue.hpp"
#include "Colours.hpp"
#include "Console.hpp"
#include "PluginOffer.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/LibraryFolder.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim/OpenGl.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// What was found out about one thing.
struct Finding {
  enum class Grade { kFine, kNote, kBroken };
  Grade grade = Grade::kFine;
  std::string text;  ///< what there is, or what is wrong and what to do about it
};
using Grade = Finding::Grade;

Finding processor() {
  const InstructionSet set = instructionSet();
  const char* name = set == InstructionSet::kAvx512 ? "AVX-512"
                     : set == InstructionSet::kAvx2 ? "AVX2"
                     : set == InstructionSet::kNeon ? "NEON"
                                                    : "the portable instructions";
  const std::string text =
      fmt::format("{} threads, loops use {}", std::thread::hardware_concurrency(), name);
  const char* asked = std::getenv("ORTUNG_SIMD");
  return {Grade::kFine, asked == nullptr ? text : text + " (ORTUNG_SIMD=" + asked + ")"};
}

Finding commands() {
  std::set<std::string> missing;
  std::size_t count = 0;
  std::error_code error;
  const fs::path folder = libraryFolder() / "ortung/commands";
  for (const CatalogueEntry& entry : catalogue()) {
    ++count;
    const auto file = folder / fmt::format("ortung_command_{}.so", entry.module);
    if (!fs::exists(file, error))
      missing.insert(fmt::format("{} (package {})", entry.name, entry.package));
  }
  if (missing.empty()) return {Grade::kFine, fmt::format("all {} are installed", count)};
  std::string text = fmt::format("{} of {} are not installed:", missing.size(), count);
  for (const std::string& one : missing) text += " " + one;
  return {Grade::kNote, text};
}

Finding plugins(double timeout) {
  std::size_t count = 0;
  std::string broken;
  for (const fs::path& library : PluginFactory(PluginFactory::standardFolders()).libraries()) {
    ++count;
    const Offer offer = lookAt(library, timeout);
    if (!offer.found.error.empty()) broken += "\n" + library.string() + ": " + offer.found.error;
  }
  if (!broken.empty()) return {Grade::kBroken, "some are broken:" + broken};
  if (count == 0) {
    std::string folders;
    for (const fs::path& folder : PluginFactory::standardFolders())
      folders += " " + folder.string();
    return {Grade::kBroken, "there are none in" + folders + "; is ORTUNG_PLUGIN_PATH right?"};
  }
  return {Grade::kFine, fmt::format("{} libraries, all can be loaded", count)};
}

Finding shippedMaps() {
  const fs::path file = shippedFile("robots", "pioneer.toml");
  std::error_code error;
  if (fs::exists(file, error))
    return {Grade::kFine, "in " + file.parent_path().parent_path().string()};
  return {Grade::kNote, "robots and fields that ship are not installed; `ortung demo` needs them"};
}

Finding openGl() {
  try {
    return {Grade::kFine, openGlRenderer()};
  } catch (const std::exception& error) {
    return {Grade::kNote, std::string("simulated cameras take no pictures: ") + error.what()};
  }
}

Finding port(unsigned number) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return {Grade::kBroken, std::string("no socket: ") + std::strerror(errno)};
  // As servers do, so that one that has just ended is none.
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(number));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int failed = ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const int why = errno;
  ::close(socket);
  if (failed == 0) return {Grade::kFine, fmt::format("127.0.0.1:{} is free", number)};
  return {Grade::kNote, fmt::format("127.0.0.1:{} can't be had ({}); --listen 0 takes a free one",
                                    number, std::strerror(why))};
}

/// Scanners, bases and cameras, which belong to groups of users.
Finding devices() {
  std::vector<std::string> mine, others;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/dev", error)) {
    const std::string name = entry.path().filename().string();
    const bool isDevice =
        name.starts_with("ttyUSB") || name.starts_with("ttyACM") || name.starts_with("video");
    if (!isDevice) continue;
    const bool isMine = ::access(entry.path().c_str(), R_OK | W_OK) == 0;
    (isMine ? mine : others).push_back(entry.path().string());
  }
  if (mine.empty() && others.empty())
    return {Grade::kFine, "no serial ports or cameras are connected"};
  std::string text = mine.empty() ? "" : fmt::format("{} can be used", fmt::join(mine, ", "));
  if (others.empty()) return {Grade::kFine, text};
  text += fmt::format("{}{} can't: become a member of the groups dialout (serial ports) and video",
                      text.empty() ? "" : "; ", fmt::join(others, ", "));
  return {Grade::kNote, text};
}

void print(const std::string& what, const Finding& finding) {
  const char* const words[] = {"ok", "note", "BROKEN"};
  std::string word = words[static_cast<int>(finding.grade)];
  word.resize(6, ' ');
  if (finding.grade == Grade::kNote) word = yellow(word, stdout);
  if (finding.grade == Grade::kBroken) word = red(word, stdout);
  std::string text;
  for (const char c : finding.text)  // further lines under the first one
    text += c == '\n' ? std::string("\n") + std::string(22, ' ') : printable({&c, 1});
  fmt::print("{} {:<14} {}\n", word, what, text);
}

}  // namespace

int runDoctor(const DoctorArguments& arguments) {
  const std::vector<std::pair<std::string, std::function<Finding()>>> checks = {
      {"processor", processor},
      {"commands", commands},
      {"plugins", [&] { return plugins(arguments.timeout); }},
      {"shipped files", shippedMaps},
      {"pictures", openGl},
      {"port", [&] { return port(arguments.port); }},
      {"devices", devices}};
  bool isBroken = false;
  fmt::print("ortung {}\n", ORTUNG_VERSION);
  for (const auto& [what, check] : checks) {
    const Finding finding = check();
    print(what, finding);
    flushOutput();  // plugins take a while
    isBroken = isBroken || finding.grade == Grade::kBroken;
  }
  return isBroken ? 1 : 0;
}

}  // namespace ortung::app

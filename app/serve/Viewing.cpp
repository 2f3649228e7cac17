#include "Viewing.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include "Console.hpp"
#include "HostPort.hpp"
#include "ortung/server/ControlToken.hpp"
#ifdef ORTUNG_HAS_FOXGLOVE
#include "FoxgloveSpeech.hpp"
#endif

extern char** environ;

namespace ortung::app {
namespace {

constexpr const char* kClient = "view";

/// Returns a token of 128 random bits.
std::string newToken() {
  std::random_device chance;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", static_cast<std::uint32_t>(chance()));
  return token;
}

WebConfig webConfigOf(const ServingArguments& arguments) {
  WebConfig config;
  if (arguments.isViewing) config.page = pageFolder();
  config.hosts = arguments.hosts;
  config.log = warn;
  config.limits.sockets = std::max<std::size_t>(config.limits.sockets, arguments.clients);
  config.limits.socketsOfAddress =
      std::max<std::size_t>(config.limits.socketsOfAddress, arguments.clientsOfAddress);
#ifdef ORTUNG_HAS_FOXGLOVE
  config.protocols.push_back(foxgloveProtocol());
#endif
  return config;
}

bool hasDesktop() {
  return ::isatty(STDOUT_FILENO) == 1 &&
         (std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr);
}

/// Opens a browser, whose output is discarded.
void showInBrowser(const std::string& url) {
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", O_RDWR, 0);
  std::string program = "xdg-open";
  std::string address = url;
  const std::array<char*, 3> words = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, "xdg-open", &files, nullptr, words.data(), environ) == 0)
    std::thread([child] { ::waitpid(child, nullptr, 0); }).detach();
  ::posix_spawn_file_actions_destroy(&files);
}

}  // namespace

std::filesystem::path pageFolder() {
  if (const char* given = std::getenv("ORTUNG_VIEW_PATH")) return given;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (const char* way : {ORTUNG_VIEW_FROM_BIN, "../share/ortung/view"}) {
    const std::filesystem::path folder = (program.parent_path() / way).lexically_normal();
    if (std::filesystem::is_directory(folder, error)) return folder;
  }
  return {};
}

Viewing::Viewing(const ServingArguments& arguments, BoardConfig& config, const WebUploads& uploads)
    : arguments_(arguments), address_(config.address) {
  if (arguments.isViewing) admitPage(config);
  WebConfig web = webConfigOf(arguments);
  web.uploads = uploads;
  BoardConfig known;
  known.tokens = config.tokens;
  known.control = config.control;
  web.uploads.admits = [known](std::string_view token) { return isControlToken(known, token); };
  door_ = std::make_unique<WebDoor>(web);
  config.http = [this](const HttpVisitor& visitor) {
    return door_->take({visitor.socket, visitor.head, visitor.peer, visitor.join});
  };
}

/// Gives the page's own client a token, unless there is one for it, and the right to control.
void Viewing::admitPage(BoardConfig& config) {
  auto& tokens = config.tokens;
  const auto isOurs = [](const BoardToken& token) { return token.name == kClient; };
  if (std::none_of(tokens.begin(), tokens.end(), isOurs)) {
    token_ = newToken();
    config.guests = tokens.empty();
    tokens.push_back({kClient, token_});
  }
  config.control.emplace_back(kClient);
}

void Viewing::open(const MessageBoard& board) {
  if (!arguments_.isViewing) return;
  const std::string url = fmt::format("http://{}:{}/", hostForBrowsers(address_), board.port());
  std::string key = token_.empty() ? "" : "#token=" + token_;
  if (!arguments_.pageKeys.empty()) key += (key.empty() ? "#" : "&") + arguments_.pageKeys;
  if (!door_->hasPage())
    warn("this program has no viewer's page (board/web/page was not built): clients only");
  fmt::print("view and control: {}{}\n", url, key);
  if (token_.empty())
    note("append #token=... with the token of 'view' in the token file");
  else if (arguments_.tokens.empty())
    fmt::print("view only:        {}\n", url);
  if (arguments_.opensBrowser && hasDesktop() && door_->hasPage()) showInBrowser(url + key);
}

}  // namespace ortung::app

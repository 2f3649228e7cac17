#include "LiveLearning.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

namespace ortung::ros2 {
namespace {

std::string programBeside() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto beside = self.parent_path() / "ortung";
  return !error && std::filesystem::exists(beside, error) ? beside.string() : "ortung";
}

}  // namespace

bool learnTables(const std::filesystem::path& world, const std::filesystem::path& robot,
                 const std::filesystem::path& tables, const std::function<bool()>& goOn) {
  const std::array<std::string, 9> words = {programBeside(), "learn",         "--world",
                                            world.string(),  "--robot",       robot.string(),
                                            "--out",         tables.string(), "--force"};
  std::array<char*, words.size() + 1> pointers{};
  for (std::size_t i = 0; i < words.size(); ++i) pointers[i] = const_cast<char*>(words[i].c_str());
  pid_t process = 0;
  if (const int error =
          ::posix_spawnp(&process, words[0].c_str(), nullptr, nullptr, pointers.data(), environ);
      error != 0)
    throw std::runtime_error(words[0] + " learn: " + std::strerror(error));
  int status = 0;
  for (;;) {
    const pid_t ended = ::waitpid(process, &status, WNOHANG);
    if (ended == process) break;
    if (ended < 0 && errno != EINTR)
      throw std::runtime_error(words[0] + " learn: " + std::strerror(errno));
    if (!goOn()) {
      ::kill(process, SIGTERM);
      ::waitpid(process, &status, 0);
      return false;
    }
    constexpr std::chrono::milliseconds kLook{20};
    std::this_thread::sleep_for(kLook);
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(words[0] + " learn has failed");
  return true;
}

}  // namespace ortung::ros2

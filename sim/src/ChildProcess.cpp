#include "ChildProcess.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <thread>

extern char** environ;

namespace ortung {
namespace {

constexpr std::size_t kMaxErrors = 4096;
constexpr std::size_t kBlock = std::size_t{1} << 16;

class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }
  void set(int number) {
    close();
    number_ = number;
  }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

struct Pipe {
  Descriptor read, write;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "pipe");
    read.set(ends[0]);
    write.set(ends[1]);
  }
};

class SpawnActions {
 public:
  SpawnActions() { posix_spawn_file_actions_init(&actions_); }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

pid_t spawn(const std::filesystem::path& program, const std::vector<std::string>& arguments,
            const Pipe& output, const Pipe& errors) {
  SpawnActions actions;
  posix_spawn_file_actions_addopen(actions.get(), 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(actions.get(), output.write.get(), 1);
  posix_spawn_file_actions_adddup2(actions.get(), errors.write.get(), 2);
  posix_spawn_file_actions_addclosefrom_np(actions.get(), 3);
  std::string name = program.string();
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv{name.data()};
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t child = -1;
  const int error = posix_spawn(&child, name.c_str(), actions.get(), nullptr, argv.data(), environ);
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot start " + name);
  return child;
}

/// Takes what is there; closes the pipe at its end.
void drain(Descriptor& pipe, std::string& into) {
  std::array<char, kBlock> block;
  const ssize_t n = ::read(pipe.get(), block.data(), block.size());
  if (n > 0) into.append(block.data(), static_cast<std::size_t>(n));
  if (n == 0 || (n < 0 && errno != EINTR && errno != EAGAIN)) pipe.close();
}

/// Reads both pipes until their ends. Returns why it stopped early, or nothing.
std::string readBoth(Pipe& output, Pipe& errors, std::size_t maxOutput,
                     std::chrono::steady_clock::time_point deadline, ChildResult& result) {
  while (output.read.get() >= 0 || errors.read.get() >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) return "took too long and was stopped";
    std::array<pollfd, 2> waited{{{output.read.get(), POLLIN, 0}, {errors.read.get(), POLLIN, 0}}};
    if (::poll(waited.data(), waited.size(), static_cast<int>(left.count())) < 0 && errno != EINTR)
      return "cannot be waited for";
    if (waited[0].revents != 0) drain(output.read, result.output);
    if (waited[1].revents != 0) drain(errors.read, result.errors);
    result.errors.resize(std::min(result.errors.size(), kMaxErrors));
    if (result.output.size() > maxOutput) return "wrote more than expected and was stopped";
  }
  return "";
}

/// Waits for the end; a child that has closed its pipes but goes on is killed at the deadline.
std::string waitFor(pid_t child, std::chrono::steady_clock::time_point deadline) {
  int status = 0;
  for (;;) {
    const bool late = std::chrono::steady_clock::now() >= deadline;
    if (late) ::kill(child, SIGKILL);
    const pid_t ended = ::waitpid(child, &status, late ? 0 : WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) return "cannot be waited for";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (WIFSIGNALED(status)) return "was ended by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "ended with status " + std::to_string(WEXITSTATUS(status));
  return "";
}

}  // namespace

ChildResult runChild(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, std::size_t maxOutput,
                     std::chrono::milliseconds limit) {
  Pipe output;
  Pipe errors;
  ChildResult result;
  const auto deadline = std::chrono::steady_clock::now() + limit;
  const pid_t child = spawn(program, arguments, output, errors);
  output.write.close();
  errors.write.close();
  const std::string stopped = readBoth(output, errors, maxOutput, deadline, result);
  if (!stopped.empty()) ::kill(child, SIGKILL);
  const std::string ended = waitFor(child, deadline);
  result.failure = stopped.empty() ? ended : stopped;
  return result;
}

}  // namespace ortung

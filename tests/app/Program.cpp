#include "Program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

#include "Paths.hpp"

extern char** environ;

namespace ortung::test {
namespace {

/// Programs inherit which signals are ignored, and those of a test that was started by nohup or in
/// the background would wait for ever for one that ends them.
[[maybe_unused]] const bool kSignalsEndPrograms = [] {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM}) std::signal(signal, SIG_DFL);
  return true;
}();

/// How UndefinedBehaviorSanitizer ends a program (CMakePresets.json); it writes no report.
constexpr int kUndefinedBehaviour = 77;

void openPipe(int ends[2]) {
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

std::vector<std::string> environmentWith(const std::vector<std::string>& additions) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const std::string key = text.substr(0, text.find('=') + 1);
    bool replaced = false;
    for (const std::string& addition : additions) replaced = replaced || addition.starts_with(key);
    if (!replaced) variables.push_back(text);
  }
  variables.insert(variables.end(), additions.begin(), additions.end());
  return variables;
}

/// Appends what is there to read; false at the end.
bool drain(int& file, std::string& text) {
  char bytes[4096];
  const ssize_t count = read(file, bytes, sizeof bytes);
  if (count > 0) {
    text.append(bytes, static_cast<std::size_t>(count));
    return true;
  }
  close(file);
  file = -1;
  return false;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment, const std::string& output) {
  std::vector<std::string> words = {ORTUNG_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environmentWith(environment);
  int out[2];
  int err[2];
  openPipe(out);
  openPipe(err);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (output == "left") {
    close(out[0]);
    out[0] = open("/dev/null", O_RDONLY | O_CLOEXEC);
  }
  if (output.empty() || output == "left") {
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  } else if (output == "closed") {
    posix_spawn_file_actions_addclose(&actions, STDOUT_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT,
                                     0600);
  }
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  const int failed = posix_spawn(&process_, ORTUNG_PROGRAM, &actions, nullptr,
                                 pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  close(out[1]);
  close(err[1]);
  out_ = out[0];
  err_ = err[0];
  if (failed != 0) throw std::runtime_error(std::string("can't run ") + ORTUNG_PROGRAM);
}

Program::~Program() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  if (out_ >= 0) close(out_);
  if (err_ >= 0) close(err_);
}

bool Program::readSome() {
  pollfd files[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};
  if (out_ < 0 && err_ < 0) return false;
  if (poll(files, 2, -1) < 0) return true;
  if (out_ >= 0 && files[0].revents != 0) drain(out_, outcome_.out);
  if (err_ >= 0 && files[1].revents != 0) drain(err_, outcome_.err);
  return true;
}

bool Program::waitForError(const std::string& text) {
  while (outcome_.err.find(text) == std::string::npos) {
    if (err_ < 0 || !readSome()) return false;
  }
  return true;
}

std::string Program::waitForOutput(const std::string& text) {
  while (outcome_.out.find(text) == std::string::npos) {
    if (out_ < 0 || !readSome()) break;
  }
  return outcome_.out;
}

void Program::signal(int number) const {
  kill(process_, number);
  siginfo_t info;
  if (number == SIGSTOP) waitid(P_PID, static_cast<id_t>(process_), &info, WSTOPPED);
}

Outcome Program::finish() {
  while (readSome()) {
  }
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  outcome_.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (outcome_.exitCode == kUndefinedBehaviour) throw std::runtime_error(outcome_.err);
  return outcome_;
}

Outcome ortung(const std::vector<std::string>& arguments,
               const std::vector<std::string>& environment, const std::string& output) {
  return Program(arguments, environment, output).finish();
}

}  // namespace ortung::test

#include "SweepRunner.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "ortung/base/NewFile.hpp"

namespace ortung::app {
namespace {

/// A file without a name, which takes what a task says.
using Diary = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

struct Running {
  const SweepTask* task = nullptr;
  Diary said;
};

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Diary newDiary() {
  Diary diary(std::tmpfile(), &std::fclose);
  if (!diary) throw std::runtime_error(std::string("no temporary file: ") + std::strerror(errno));
  return diary;
}

std::string textIn(std::FILE* diary) {
  if (std::fseek(diary, 0, SEEK_SET) != 0) return "";
  std::string text;
  std::array<char, 4096> piece{};
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), diary))
    text.append(piece.data(), n);
  return text;
}

}  // namespace

/// @param said descriptor that takes what it says @returns the process
int SweepRunner::start(const SweepTask& task, int said) const {
  std::vector<std::string> words = {"ortung"};
  words.insert(words.end(), task.words.begin(), task.words.end());
  for (const std::string& word : {std::string("--shard"), std::string("1/1"), std::string("--json"),
                                  store_.partOf(task.id).string(), std::string("--force")})
    words.push_back(word);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, sweep_.folder().c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, said, STDERR_FILENO);
  pid_t process = 0;
  const int error =
      posix_spawn(&process, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw std::runtime_error("task " + task.name + " can't be started: " + std::strerror(error));
  return process;
}

std::vector<std::string> SweepRunner::run(const std::vector<SweepTask>& tasks,
                                          const std::function<void(std::size_t)>& done) {
  std::map<pid_t, Running> running;
  std::vector<std::string> failed;
  std::size_t next = 0;
  std::size_t ended = 0;
  bool isTold = false;  ///< whether the user knows that the signal came
  while (ended < tasks.size()) {
    while (next < tasks.size() && running.size() < jobs_ && interruptSignal() == 0) {
      Diary diary = newDiary();
      const int process = start(tasks[next], ::fileno(diary.get()));
      running.emplace(process, Running{&tasks[next], std::move(diary)});
      ++next;
    }
    if (running.empty()) checkInterrupt();
    if (interruptSignal() != 0 && !std::exchange(isTold, true))
      warn(fmt::format(
          "ends after the running {}; what is done stays done, the same command goes on",
          running.size() == 1 ? "task" : "tasks"));
    int status = 0;
    struct rusage usage{};
    const pid_t process = ::wait4(-1, &status, 0, &usage);
    if (process < 0 && errno != EINTR)
      throw std::runtime_error(std::string("tasks can't be waited for: ") + std::strerror(errno));
    const auto one = running.find(process);
    if (one == running.end()) continue;
    const SweepTask& task = *one->second.task;
    ++ended;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      costs_[task.id] = {secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime),
                         static_cast<double>(usage.ru_maxrss) / 1024.0};
    } else {
      failed.push_back(task.name);
      writeFile(store_.failureOf(task.id), textIn(one->second.said.get()));
    }
    running.erase(one);
    done(ended);
  }
  checkInterrupt();
  return failed;
}

}  // namespace ortung::app

#include "ortung/base/HelperProgram.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "ortung/base/InputFile.hpp"
#include "ortung/base/LibraryFolder.hpp"

namespace ortung {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
};

[[noreturn]] void failWith(const std::string& about, const std::string& what) {
  throw std::runtime_error(about + ": " + what);
}

pid_t spawn(const std::string& program, const std::vector<std::string>& arguments, int output,
            const std::string& about) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  std::vector<std::string> texts{program};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& text : texts) argv.push_back(text.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    failWith(about, program + " does not start: " + std::generic_category().message(error));
  return child;
}

/// Returns where helper programs may be: the environment's folder, or else the running program's
/// and those where the library's helpers were installed or built.
std::vector<std::filesystem::path> helperFolders() {
  if (const char* folder = std::getenv("ORTUNG_LIBEXEC"); folder && *folder) return {folder};
  std::vector<std::filesystem::path> folders;
  std::error_code error;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (!error) folders.push_back(own);
  const std::filesystem::path library = libraryFolder();
  if (library.empty()) return folders;
  folders.push_back((library / ORTUNG_LIBEXEC_FROM_LIB).lexically_normal());
  folders.push_back(library.parent_path() / "bin");
  return folders;
}

/// Reads everything up to the end, but no more than maxBytes + 1.
std::string readAll(int input, std::size_t maxBytes) {
  std::string bytes;
  std::array<char, 1u << 16> block;
  while (bytes.size() <= maxBytes) {
    const ssize_t count = ::read(input, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
  return bytes;
}

int waitFor(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// Returns what the program itself says about its failure.
std::string lastWords(const std::string& output) {
  const std::string mark = "# error ";
  const std::size_t at = output.rfind(mark);
  if (at == std::string::npos) return "";
  std::string text = output.substr(at + mark.size(), 400);
  for (char& c : text) {
    if (c < ' ' || c >= 127) c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return ": " + text;
}

void check(int status, const std::string& program, const std::string& output,
           const std::string& about) {
  const std::string name = std::filesystem::path(program).filename().string();
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    failWith(about, name + " was ended by signal " + std::to_string(number) + " (" +
                        ::strsignal(number) + "); the file is damaged or too large");
  }
  if (WEXITSTATUS(status) != 0) {  // waitpid() reports no other end
    failWith(about, name + " ended with status " + std::to_string(WEXITSTATUS(status)) +
                        lastWords(output));
  }
}

}  // namespace

std::filesystem::path findHelper(const std::string& name, const std::string& about) {
  std::string places;
  for (const auto& folder : helperFolders()) {
    const auto program = folder / name;
    if (::access(program.c_str(), X_OK) == 0) return program;
    places += (places.empty() ? "" : ", ") + folder.string();
  }
  failWith(about, "the program " + name + " is needed, which is not in " + places +
                      "; build with ORTUNG_MRPT=ON or name its folder in ORTUNG_LIBEXEC");
}

std::string runHelper(const std::filesystem::path& program,
                      const std::vector<std::string>& arguments, const std::string& about,
                      std::size_t maxBytes) {
  // Only arguments that name files count.
  for (const std::string& argument : arguments) noteInput(argument);
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    failWith(about, "no pipe: " + std::generic_category().message(errno));
  }
  Descriptor input(ends[0]);
  Descriptor output(ends[1]);
  const pid_t child = spawn(program.string(), arguments, output.get(), about);
  output.close();
  std::string bytes;
  try {
    bytes = readAll(input.get(), maxBytes);
  } catch (...) {  // no memory: the child must not stay behind
    ::kill(child, SIGKILL);
    waitFor(child);
    throw;
  }
  const bool tooMuch = bytes.size() > maxBytes;
  if (tooMuch) ::kill(child, SIGKILL);
  input.close();
  const int status = waitFor(child);
  if (tooMuch) {
    failWith(about, program.filename().string() + " wrote more than " + std::to_string(maxBytes) +
                        " bytes, expected no more");
  }
  check(status, program.string(), bytes, about);
  return bytes;
}

}  // namespace ortung

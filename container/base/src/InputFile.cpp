#include "ortung/base/InputFile.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

namespace ortung {
namespace {

using Identity = std::pair<dev_t, ino_t>;

struct Inputs {
  std::mutex mutex;
  std::map<Identity, std::filesystem::path> files;  ///< first name of each file
};

/// Files that any part of the process has read: before a file is replaced, it is looked up here.
Inputs& inputs() {
  static Inputs instance;
  return instance;
}

void note(const std::filesystem::path& file, const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return;
  const std::lock_guard lock(inputs().mutex);
  inputs().files.try_emplace({status.st_dev, status.st_ino}, file);
}

}  // namespace

std::string cantBeRead(int error) {
  return "can't be read: " + std::generic_category().message(error == 0 ? EIO : error);
}

std::ifstream openInput(const std::filesystem::path& file, std::string& why) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  int error = in ? 0 : errno;
  struct stat status{};
  const bool isThere = ::stat(file.c_str(), &status) == 0;
  if (S_ISDIR(status.st_mode)) {  // the stream would open, and then be empty
    error = EISDIR;
    in.setstate(std::ios::failbit);
  }
  if (!in) {
    why = cantBeRead(error);
  } else if (isThere) {
    note(file, status);
  }
  return in;
}

void noteInput(const std::filesystem::path& file) {
  struct stat status{};
  if (::stat(file.c_str(), &status) == 0) note(file, status);
}

bool isInput(const std::filesystem::path& file) {
  struct stat status{};
  if (::stat(file.c_str(), &status) != 0) return false;
  const std::lock_guard lock(inputs().mutex);
  return inputs().files.contains({status.st_dev, status.st_ino});
}

std::vector<std::filesystem::path> allInputs() {
  std::vector<std::filesystem::path> names;
  const std::lock_guard lock(inputs().mutex);
  for (const auto& [identity, name] : inputs().files) names.push_back(name);
  return names;
}

}  // namespace ortung

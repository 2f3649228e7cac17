#include "ortung/base/InputFile.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

namespace ortung {
namespace {

using Identity = std::pair<dev_t, ino_t>;

struct Inputs {
  std::mutex mutex;
  std::set<Identity> files;
};

/// Files that any part of the process has read: before a file is replaced, it is looked up here.
Inputs& inputs() {
  static Inputs instance;
  return instance;
}

void note(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return;
  const std::lock_guard lock(inputs().mutex);
  inputs().files.emplace(status.st_dev, status.st_ino);
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
    note(status);
  }
  return in;
}

void noteInput(const std::filesystem::path& file) {
  struct stat status{};
  if (::stat(file.c_str(), &status) == 0) note(status);
}

bool isInput(const std::filesystem::path& file) {
  struct stat status{};
  if (::stat(file.c_str(), &status) != 0) return false;
  const std::lock_guard lock(inputs().mutex);
  return inputs().files.contains({status.st_dev, status.st_ino});
}

}  // namespace ortung

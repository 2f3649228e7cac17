#include "OutputFile.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace ortung::app {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

std::filesystem::path folderOf(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// A file that vanishes unless it is renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target)
      : target_(target), name_(target.string() + ".tmp-" + std::to_string(getpid())),
        descriptor_(open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) fail();
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!renamed_) unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  void rename() {
    if (fsync(descriptor_) != 0) fail();
    if (std::rename(name_.c_str(), target_.c_str()) != 0) fail();
    renamed_ = true;
    syncFolder();
  }

 private:
  [[noreturn]] void fail() const {
    refuse(target_, std::string("can't be written: ") + std::strerror(errno));
  }

  void syncFolder() const {
    const int folder = open(folderOf(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;  // the file is in place; only a power failure could undo it
    fsync(folder);
    close(folder);
  }

  std::filesystem::path target_;
  std::string name_;
  int descriptor_;
  bool renamed_ = false;
};

}  // namespace

void checkOutput(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) refuse(file, "is a folder, expected a file");
  const std::filesystem::path folder = folderOf(file);
  if (!std::filesystem::is_directory(folder, error)) {
    refuse(file, "can't be written: there is no folder " + folder.string());
  }
  if (access(folder.c_str(), W_OK) != 0) {
    refuse(file, std::string("can't be written: ") + std::strerror(errno));
  }
}

void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  TemporaryFile temporary(file);
  temporary.write(bytes);
  temporary.rename();
}

void writeFile(const std::filesystem::path& file, std::string_view text) {
  writeFile(file, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace ortung::app

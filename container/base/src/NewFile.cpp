#include "ortung/base/NewFile.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace ortung {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBuffered = 1u << 16;
constexpr std::string_view kPart = ".ortung-part-";  // followed by a process and a number

std::string descriptorName(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// N of /dev/fd/N and /proc/self/fd/N, or -1.
int ownDescriptor(const fs::path& file) {
  std::string name = file.string();
  for (const std::string folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(folder)) continue;
    int number = -1;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + folder.size(), end, number);
    if (error == std::errc() && rest == end) return number;
  }
  return -1;
}

/// Returns the standard output that has this very file open, or -1: if the file was replaced, other
/// output to it would be lost.
int openAsOutput(const struct stat& status) {
  for (const int output : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat other{};
    if (::fstat(output, &other) == 0 && other.st_dev == status.st_dev &&
        other.st_ino == status.st_ino)
      return output;
  }
  return -1;
}

/// Removes parts whose writer is gone: a writer holds its part's lock, so an unlocked part is dead.
void clearDeadParts(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!it->path().filename().string().starts_with(kPart)) continue;
    const int part =
        ::open(it->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (part < 0) continue;
    if (::flock(part, LOCK_EX | LOCK_NB) == 0) ::unlink(it->path().c_str());
    ::close(part);
  }
}

fs::path nextPart(const fs::path& folder) {
  static std::atomic<unsigned> count{0};
  return folder / (std::string(kPart) + std::to_string(::getpid()) + "-" + std::to_string(++count));
}

/// Returns whether the error only says that the system or the file does not support the call.
bool isUnsupported(int error) { return error == EINVAL || error == EROFS || error == ENOTSUP; }

}  // namespace

fs::path behindLinks(const fs::path& file) {
  constexpr int kMostLinks = 40;  // as many as the system follows
  fs::path place = file;
  for (int i = 0; i < kMostLinks && ownDescriptor(place) < 0; ++i) {
    std::error_code error;
    const fs::path next = fs::read_symlink(place, error);
    if (error) break;
    place = next.is_absolute() ? next : place.parent_path() / next;
  }
  return place;
}

NewFile::NewFile(fs::path file) : file_(std::move(file)) {
  try {
    open();
  } catch (...) {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (state_ == State::kNamed) ::unlink(named_.c_str());
    throw;
  }
}

NewFile::~NewFile() {
  if (state_ == State::kInPlace || state_ == State::kStream) {
    try {
      emptyBuffer();
    } catch (const std::exception&) {  // callers that need the error call commit()
    }
  }
  if (state_ == State::kNamed) ::unlink(named_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
}

void NewFile::fail() const {
  // With the code, by which a program knows a reader that has left.
  throw std::system_error(errno, std::generic_category(), file_.string() + ": can't be written");
}

void NewFile::open() {
  place_ = behindLinks(file_);
  folder_ = place_.has_parent_path() ? place_.parent_path() : ".";
  struct stat status{};
  const bool exists = ::stat(place_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail();
  int own = ownDescriptor(place_);
  if (own < 0 && exists) own = openAsOutput(status);
  if (own >= 0) {
    if (own == STDOUT_FILENO) std::fflush(stdout);  // earlier output comes first
    descriptor_ = ::fcntl(own, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    state_ = State::kStream;
  } else if (exists && S_ISDIR(status.st_mode)) {
    errno = EISDIR;
    fail();
  } else if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(place_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
    state_ = State::kStream;
  } else {
    // Its folder would let us replace it, but a file without the right to write is protected on
    // purpose.
    if (exists && ::access(place_.c_str(), W_OK) != 0) fail();
    openUnnamedOrNamed();
    if (exists) keepOwnership();
  }
  if (descriptor_ < 0) fail();
}

void NewFile::openUnnamedOrNamed() {
  if (::access("/proc/self/fd", X_OK) == 0) {  // putInPlace() names the file by it
    descriptor_ = ::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
      ::flock(descriptor_, LOCK_EX | LOCK_NB);
      state_ = State::kUnnamed;
      return;
    }
    if (errno != EISDIR && !isUnsupported(errno)) fail();
  }
  openNamed();
}

void NewFile::openNamed() {
  clearDeadParts(folder_);
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    named_ = nextPart(folder_);
    descriptor_ = ::open(named_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) fail();
    struct stat status{};
    ::flock(descriptor_, LOCK_EX);
    if (::fstat(descriptor_, &status) == 0 && status.st_nlink > 0) {
      state_ = State::kNamed;
      return;
    }
    ::close(std::exchange(descriptor_, -1));  // it was taken for dead before it was locked
  }
  errno = EEXIST;
  fail();
}

/// Gives the new file the owner, group and permissions of the old one.
void NewFile::keepOwnership() {
  struct stat old{};
  struct stat own{};
  if (::stat(place_.c_str(), &old) != 0 || ::fstat(descriptor_, &own) != 0) return;
  const bool isOthers = old.st_uid != own.st_uid || old.st_gid != own.st_gid;
  // We may not give it to the owner.
  if (isOthers && ::fchown(descriptor_, old.st_uid, old.st_gid) != 0) return;
  ::fchmod(descriptor_, old.st_mode & 0777);
}

void NewFile::write(std::span<const std::byte> bytes) {
  buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (buffer_.size() >= kMostBuffered) emptyBuffer();
}

void NewFile::emptyBuffer() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t count = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int error = count == 0 ? ENOSPC : errno;
      buffer_.clear();
      if (state_ == State::kInPlace && ::ftruncate(descriptor_, static_cast<off_t>(flushed_)) == 0)
        size_ = flushed_;
      errno = error;
      fail();
    }
    done += static_cast<std::size_t>(count);
    size_ += static_cast<std::size_t>(count);
  }
  buffer_.clear();
}

void NewFile::flush() {
  emptyBuffer();
  flushed_ = size_;
}

void NewFile::publish() {
  flush();
  putInPlace();
}

void NewFile::commit() {
  flush();
  if (::fsync(descriptor_) != 0 && !isUnsupported(errno)) fail();
  putInPlace();
  const bool inPlace = state_ == State::kInPlace;
  state_ = State::kClosed;
  if (::close(std::exchange(descriptor_, -1)) != 0) fail();
  if (inPlace) syncFolder();
}

void NewFile::putInPlace() {
  if (state_ == State::kNamed) {
    replace(named_);
    state_ = State::kInPlace;
  }
  if (state_ != State::kUnnamed) return;
  const std::string source = descriptorName(descriptor_);
  const auto link = [&](const fs::path& name) {
    return ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (!link(place_)) {
    if (errno != EEXIST) fail();
    clearDeadParts(folder_);
    fs::path name = nextPart(folder_);
    while (!link(name)) {
      if (errno != EEXIST) fail();
      name = nextPart(folder_);
    }
    replace(name);
  }
  state_ = State::kInPlace;
}

void NewFile::replace(const fs::path& named) {
  if (::rename(named.c_str(), place_.c_str()) == 0) return;
  const int error = errno;
  ::unlink(named.c_str());
  errno = error;
  fail();
}

/// Syncs the folder, so that the name survives a power failure, too. Fails silently, as the file is
/// in place in any case.
void NewFile::syncFolder() const {
  const int descriptor = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

void writeFile(const fs::path& file, std::span<const std::byte> bytes) {
  NewFile out(file);
  out.write(bytes);
  out.commit();
}

void writeFile(const fs::path& file, std::string_view text) {
  writeFile(file, std::as_bytes(std::span(text)));
}

}  // namespace ortung

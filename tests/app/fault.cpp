// Preloaded into a program: makes one of its system calls on a folder's files fail, once.
//   ORTUNG_FAULT="CALL N ERRNO", e.g. "write 2 28": the second write() fails with ENOSPC
//   ORTUNG_FAULT_FOLDER          only calls on files directly in that folder count
//   ORTUNG_FAULT_MARK            file that is made when it has happened
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

using namespace std::string_literals;

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string fileOf(int descriptor) {
  char target[4096];
  const ssize_t size =
      ::readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), target, sizeof target);
  return size > 0 ? std::string(target, static_cast<std::size_t>(size)) : "";
}

bool isWithin(const std::string& file) {
  return file.starts_with(variable("ORTUNG_FAULT_FOLDER") + "/");
}

/// Whether this call is the one; then errno is set.
bool fails(const char* call) {
  static std::atomic<int> count{0};
  char wanted[32] = "";
  int which = 0;
  int error = 0;
  if (std::sscanf(variable("ORTUNG_FAULT").c_str(), "%31s %d %d", wanted, &which, &error) != 3)
    return false;
  if (std::strcmp(wanted, call) != 0 || ++count != which) return false;
  const int mark =
      next<int(const char*, mode_t)>("creat")(variable("ORTUNG_FAULT_MARK").c_str(), 0600);
  next<int(int)>("close")(mark);
  errno = error;
  return true;
}

int openWith(const char* name, const char* file, int flags, mode_t mode) {
  const bool makes = (flags & O_TMPFILE) == O_TMPFILE
                         ? std::string(file) == variable("ORTUNG_FAULT_FOLDER")
                         : (flags & O_CREAT) != 0 && isWithin(file);
  if (makes && fails("open")) return -1;
  return next<int(const char*, int, mode_t)>(name)(file, flags, mode);
}

mode_t modeOf(int flags, va_list more) {
  const bool hasMode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  return hasMode ? va_arg(more, mode_t) : 0;
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

int open(const char* file, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = modeOf(flags, more);
  va_end(more);
  return openWith("open", file, flags, mode);
}

int open64(const char* file, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = modeOf(flags, more);
  va_end(more);
  return openWith("open64", file, flags, mode);
}

ssize_t read(int descriptor, void* bytes, size_t size) {
  if (isWithin(fileOf(descriptor)) && fails("read")) return -1;
  return next<ssize_t(int, void*, size_t)>("read")(descriptor, bytes, size);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (isWithin(fileOf(descriptor)) && fails("write")) return -1;
  return next<ssize_t(int, const void*, size_t)>("write")(descriptor, bytes, size);
}

int fsync(int descriptor) {
  if (isWithin(fileOf(descriptor)) && fails("fsync")) return -1;
  return next<int(int)>("fsync")(descriptor);
}

int close(int descriptor) {
  // What was opened to be read may be closed with any result.
  const bool isWritten = (::fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY;
  const bool failed = isWritten && isWithin(fileOf(descriptor)) && fails("close");
  const int error = errno;
  const int result = next<int(int)>("close")(descriptor);
  if (failed) errno = error;
  return failed ? -1 : result;
}

int rename(const char* from, const char* to) noexcept {
  if (isWithin(to) && fails("rename")) return -1;
  return next<int(const char*, const char*)>("rename")(from, to);
}

int linkat(int fromFolder, const char* from, int toFolder, const char* to, int flags) noexcept {
  if (isWithin(to) && fails("linkat")) return -1;
  return next<int(int, const char*, int, const char*, int)>("linkat")(fromFolder, from, toFolder,
                                                                      to, flags);
}
}
#pragma GCC visibility pop

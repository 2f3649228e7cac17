#include "Console.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "Colours.hpp"

namespace ortung::app {
namespace {

bool isControl(std::string_view text, std::size_t i) {
  const auto byte = static_cast<unsigned char>(text[i]);
  if (byte < 0x20 || byte == 0x7F) return true;
  // The C1 controls in UTF-8 are 0xC2 0x80 to 0xC2 0x9F.
  const bool afterC2 = i > 0 && static_cast<unsigned char>(text[i - 1]) == 0xC2;
  return afterC2 && byte >= 0x80 && byte < 0xA0;
}

bool hasNoReader() {
  pollfd out{STDOUT_FILENO, 0, 0};
  return ::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

spdlog::logger& logger() {
  static spdlog::logger instance("ortung", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  return instance;
}

}  // namespace

void setCommandName(const std::string& name) { logger().set_pattern(name + ": %v"); }

void note(const std::string& text) { logger().info("{}", printable(text)); }
void warn(const std::string& text) {
  logger().warn("{} {}", yellow("warning:", stderr), printable(text));
}
void fail(const std::string& text) { logger().error("{}", red(printable(text), stderr)); }

void reserveStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // It is opened for the other direction, and gets the lowest free descriptor, which is this one.
    if (::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  }
}

void flushOutput() {
  static int error = 0;  // the first error, which causes the later ones
  const bool hasFailed = std::ferror(stdout) != 0;
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && !hasFailed) return;
  // If a print failed before, its error is lost; writing nothing returns it again, but of a pipe.
  if (errno == 0 && ::write(STDOUT_FILENO, "", 0) == 0) errno = hasNoReader() ? EPIPE : EIO;
  if (error == 0) error = errno;
  throw std::system_error(error, std::generic_category(), "standard output: can't be written");
}

bool isReaderGone(const std::exception& error) {
  const auto* const system = dynamic_cast<const std::system_error*>(&error);
  return system != nullptr && system->code() == std::errc::broken_pipe;
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (isControl(text, i)) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
    } else {
      out += text[i];
    }
  }
  return out;
}

}  // namespace ortung::app

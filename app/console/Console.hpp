#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ortung::app {

/// An error in the command line: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Sets the name with which messages begin, e.g. "ortung learn: ".
void setCommandName(const std::string& name);

// These print messages to stderr, one line each; results go to stdout.
void note(const std::string& text);
void warn(const std::string& text);
void fail(const std::string& text);

/// Reserves the descriptors of closed standard streams, so that files that are opened later do not
/// get them. Reading and writing these streams fails.
void reserveStandardStreams();

/// Flushes stdout. @throws std::system_error if it can't be written
void flushOutput();

/// Whether an error says that the reader of a pipe has left, as `| head` does: nobody wants the
/// rest, and the program ends quietly with kReaderLeft.
bool isReaderGone(const std::exception& error);
/// The exit code of a program that SIGPIPE ends.
inline constexpr int kReaderLeft = 128 + 13;

/// Returns @p text with control characters, which a hostile file could send to the terminal, as
/// \xNN.
std::string printable(std::string_view text);

}  // namespace ortung::app

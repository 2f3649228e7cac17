#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace ortung::app {

/// The command line asks for something that makes no sense: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Sets what messages begin with: "ortung learn: ".
void setCommandName(const std::string& name);

// Messages to stderr, one line each; results go to stdout.
void note(const std::string& text);
void warn(const std::string& text);
void fail(const std::string& text);

/// Gives closed standard streams something to stand for them, so that no file that is opened later
/// takes their number: reading and writing them fails.
void reserveStandardStreams();

/// Hands on what was printed. @throws std::runtime_error if stdout can't be written
void flushOutput();

/// @p text without control characters, which a hostile file could send to the terminal:
/// they appear as \xNN.
std::string printable(std::string_view text);

}  // namespace ortung::app

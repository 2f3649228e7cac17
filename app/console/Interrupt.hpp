#pragma once

#include <exception>

namespace ortung::app {

/// SIGINT (Ctrl-C), SIGTERM or SIGHUP ended the command; files are left as they were.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted; no file was written"; }
};

/// Installs handlers: SIGINT, SIGTERM and SIGHUP are noted; a second one ends the program at once.
/// Writing to a pipe without a reader, or beyond a file's limit, becomes an error instead of a
/// signal.
void catchInterrupts();

/// Returns the signal that came, or 0.
int interruptSignal();

/// @throws Interrupted if a signal came
void checkInterrupt();

}  // namespace ortung::app

#pragma once

#include <exception>

namespace ortung::app {

/// Ctrl-C, a request to end or a terminal that is gone; files are left as they were.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted; no file was written"; }
};

/// From now on SIGINT, SIGTERM and SIGHUP are noted; a second one ends the program at once. Pipes
/// without a reader and files that may not grow are errors of who writes.
void catchInterrupts();

/// The signal that came, or 0.
int interruptSignal();

/// @throws Interrupted if a signal came
void checkInterrupt();

}  // namespace ortung::app

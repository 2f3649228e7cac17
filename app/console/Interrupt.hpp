#pragma once

#include <exception>

namespace ortung::app {

/// Ctrl-C or a request to end; results are left as they were.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted; nothing was written"; }
};

/// From now on SIGINT and SIGTERM are noted; a second one ends the program at once.
void catchInterrupts();

/// The signal that came, or 0.
int interruptSignal();

/// @throws Interrupted if a signal came
void checkInterrupt();

}  // namespace ortung::app

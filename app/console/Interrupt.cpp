#include "Interrupt.hpp"

#include <atomic>
#include <csignal>

namespace ortung::app {
namespace {

std::atomic<int> received{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may use nothing else");

extern "C" void noteSignal(int signal) { received.store(signal, std::memory_order_relaxed); }

}  // namespace

void catchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = noteSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // so that a second one ends the program
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup, a job with &
  }
  // A failed write must be an error, not the end of the program before its other files are
  // complete. These are handlers because child processes would inherit SIG_IGN.
  action.sa_handler = [](int) {};
  action.sa_flags = 0;
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaction(signal, &action, nullptr);
}

int interruptSignal() { return received.load(std::memory_order_relaxed); }

void checkInterrupt() {
  if (interruptSignal() != 0) throw Interrupted();
}

}  // namespace ortung::app

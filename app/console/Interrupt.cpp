#include "Interrupt.hpp"

#include <atomic>
#include <csignal>

namespace ortung::app {
namespace {

std::atomic<int> received{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may touch nothing else");

extern "C" void noteSignal(int signal) { received.store(signal, std::memory_order_relaxed); }

}  // namespace

void catchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = noteSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second one is for those in a hurry
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup, a job with &
  }
  // What can't be written any more is an error like others, not the death of the program before its
  // other files are whole. Handlers, since programs that we start would inherit SIG_IGN.
  action.sa_handler = [](int) {};
  action.sa_flags = 0;
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaction(signal, &action, nullptr);
}

int interruptSignal() { return received.load(std::memory_order_relaxed); }

void checkInterrupt() {
  if (interruptSignal() != 0) throw Interrupted();
}

}  // namespace ortung::app

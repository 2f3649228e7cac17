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
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interruptSignal() { return received.load(std::memory_order_relaxed); }

void checkInterrupt() {
  if (interruptSignal() != 0) throw Interrupted();
}

}  // namespace ortung::app

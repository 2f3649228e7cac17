#include "Scheduling.hpp"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "ortung/server/Patience.hpp"

namespace ortung::server {
namespace {

// As of nice(1): a tenth of the weight of others. Lower ones, or SCHED_IDLE, would keep readings
// from a container, of which it looks at a few under a lock, for too long where others have all
// processors.
constexpr std::int32_t kLow = 10;
// A thread that wakes up preempts at once one whose slice is longer than its own; otherwise it
// waits for the end of that slice, up to 3 ms. Before Linux 6.12 all slices have the same length,
// and there it changes nothing [ns].
constexpr std::uint64_t kLongSlice = 100'000'000;
constexpr std::uint64_t kShortSlice = 100'000;

/// What sched_setattr(2) takes; glibc 2.36 has no name for it, and Linux' own header can't stand
/// beside <sched.h>.
struct Attributes {
  std::uint32_t size = 0;
  std::uint32_t policy = 0;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime = 0;
  std::uint64_t deadline = 0;
  std::uint64_t period = 0;
};

Attributes present() {
  Attributes attributes;
  ::syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0U);
  return attributes;
}

void set(Attributes attributes) { ::syscall(SYS_sched_setattr, 0, &attributes, 0U); }

/// @param slice [ns] Who started the program may have chosen another way of scheduling: it stays.
void useSlice(std::uint64_t slice) {
  Attributes attributes = present();
  if (attributes.policy != SCHED_OTHER) return;
  attributes.runtime = slice;
  set(attributes);
}

}  // namespace

void stepBack() {
  set({.size = sizeof(Attributes),
       .policy = SCHED_BATCH,
       .nice = std::max(kLow, present().nice),
       .runtime = kLongSlice});
}

void comeForward() { useSlice(kShortSlice); }

}  // namespace ortung::server

namespace ortung {

Patience::Patience(std::chrono::microseconds slice) : before_(server::present().runtime) {
  const auto wanted = static_cast<std::uint64_t>(std::chrono::nanoseconds(slice).count());
  if (before_ > 0) server::useSlice(std::max(wanted, before_));
}

Patience::~Patience() {
  if (before_ > 0) server::useSlice(before_);
}

}  // namespace ortung

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <latch>

#include "BoardClock.hpp"
#include "ProcessorShare.hpp"
#include "SlowWork.hpp"
#include "ortung/server/ProcessorTime.hpp"

namespace ortung::server {
namespace {

SlowTask taskOf(std::function<void()> work) {
  return {[] { return true; }, std::move(work), [] {}};
}

int priority() { return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())); }

TEST(SlowWork, GivesClientsTurnsAndHasALowPriority) {
  SlowWork work(1.0);
  std::latch begun{1};
  std::latch let{1};
  std::latch done{1};
  const int usual = priority();
  int itsOwn = 0;
  int policy = 0;
  int directors = 0;
  work.give(1, {[] { return true; },
                [&] {
                  itsOwn = priority();
                  policy = ::sched_getscheduler(0);
                  begun.count_down();
                  let.wait();
                },
                [&] { directors = priority(); }});
  begun.wait();
  std::string order;
  work.give(2, taskOf([&] { order += "2"; }));
  work.give(3, taskOf([&] { order += "3"; }));
  work.give(2, taskOf([&] { order += "b"; }));  // in the place of the first
  work.give(5, {[] { return false; }, [&] { order += "5"; }, [&] { order += "5"; }});
  work.give(1, taskOf([&] { order += "1"; }));
  work.give(4, taskOf([&] { done.count_down(); }));
  let.count_down();
  done.wait();
  EXPECT_EQ(order, "b31");
  EXPECT_EQ(itsOwn, std::max(10, usual));
  EXPECT_EQ(policy, SCHED_BATCH) << "it takes no processor from anyone when it wakes up";
  EXPECT_EQ(directors, usual) << "nobody waits for a thread that may get no processor";
}

TEST(SlowWork, WhoNeverRestsGetsItsShareOfEverySecondAndNoMore) {
  constexpr double kShare = 0.25;
  constexpr double kSlice = 0.0003;         // that it takes before it asks [s]
  constexpr Timestamp kSecond = 1'000'000;  // [us]
  ProcessorShare share(kShare);
  Timestamp now = kSecond;
  double used = 0.0;
  double before = 0.0;
  for (int second = 0; second < 10; ++second) {
    const Timestamp end = now + kSecond;
    while (now < end) {
      used += kSlice;
      now += fromSeconds(kSlice);
      now += fromSeconds(share.charge(used, now));
    }
    // In the first second it also takes what was there at the beginning.
    EXPECT_NEAR(used - before, second == 0 ? 2 * kShare : kShare, 0.002) << second;
    before = used;
  }
}

TEST(SlowWork, HoldsUpOnlyItsOwnThread) {
  SlowWork work(1e-6);  // nothing can ever be paid for
  work.pace();
  std::latch begun{1};
  work.give(1, taskOf([&] {
              begun.count_down();
              for (int i = 0; i < 100; ++i) work.pace();  // for hours, but for the end
            }));
  begun.wait();
}

/// Keeps a processor busy for so long. @returns the processor time that was used [s]
double work(double seconds) {
  const double begin = processorTime();
  double used = 0.0;
  while (used < seconds) used = processorTime() - begin;
  return used;
}

// However busy the computer is, this takes as long at least: no test can fail by being late.
TEST(SlowWork, WhatIsBeyondItsShareIsWaitedForBeforeTheNextTask) {
  constexpr double kShare = 0.2;  // of a processor; what a second gives is there at the beginning
  double used = 0.0;
  double end = 0.0;
  double next = 0.0;
  std::latch done{1};
  SlowWork slow(kShare);
  slow.give(1, taskOf([&] {
              used = work(kShare + 0.05);
              end = toSeconds(wallTime());
            }));
  slow.give(2, taskOf([&] {
              next = toSeconds(wallTime());
              done.count_down();
            }));
  done.wait();
  EXPECT_GE(next - end, (used - kShare) / kShare - 0.001);
}

}  // namespace
}  // namespace ortung::server

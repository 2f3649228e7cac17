#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <latch>

#include "SlowWork.hpp"

namespace ortung::server {
namespace {

TEST(SlowWork, GivesClientsTurnsAndHasTheLowestPriority) {
  SlowWork work(1.0);
  std::latch begun{1};
  std::latch let{1};
  std::latch done{1};
  int priority = 0;
  work.give(1, [&] {
    priority = ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
    begun.count_down();
    let.wait();
  });
  begun.wait();
  std::string order;
  work.give(2, [&] { order += "2"; });
  work.give(3, [&] { order += "3"; });
  work.give(2, [&] { order += "b"; });  // in the place of the first
  work.give(1, [&] { order += "1"; });
  work.give(4, [&] { done.count_down(); });
  let.count_down();
  done.wait();
  EXPECT_EQ(order, "b31");
  EXPECT_EQ(priority, 19);
  EXPECT_NE(::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())), 19) << "nobody else";
}

TEST(SlowWork, HoldsUpOnlyItsOwnThread) {
  SlowWork work(1e-6);  // nothing can ever be paid for
  work.pace();
  std::latch begun{1};
  work.give(1, [&] {
    begun.count_down();
    for (int i = 0; i < 100; ++i) work.pace();  // for hours, but for the end
  });
  begun.wait();
}

}  // namespace
}  // namespace ortung::server

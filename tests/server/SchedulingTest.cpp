#include <gtest/gtest.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <thread>

#include "Scheduling.hpp"
#include "ortung/server/Patience.hpp"

namespace ortung::server {
namespace {

/// Slice of the thread that calls [ns]; 0: this system has none of one's own.
std::uint64_t slice() {
  struct {  // as of sched_setattr(2)
    std::uint32_t size, policy;
    std::uint64_t flags;
    std::uint32_t nice, priority;
    std::uint64_t runtime, deadline, period;
  } attributes{};
  ::syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0U);
  return attributes.policy == SCHED_OTHER ? attributes.runtime : 0;
}

class Scheduling : public ::testing::Test {
 protected:
  void SetUp() override {
    if (slice() == 0) GTEST_SKIP() << "threads have no slices of their own here";
  }
};

TEST_F(Scheduling, PatienceIsALongerSliceThanOthersHaveUntilItEnds) {
  const std::uint64_t usual = slice();
  {
    const Patience patience(Patience::kWorld);
    const std::uint64_t worlds = slice();
    EXPECT_GT(worlds, usual);
    std::thread([&] {
      const Patience more(Patience::kBeside);
      EXPECT_GT(slice(), worlds);
    }).join();
  }
  EXPECT_EQ(slice(), usual);
}

TEST_F(Scheduling, WhoComesForwardHasAShorterSliceThanOthersAndChangesNobodyElses) {
  const std::uint64_t usual = slice();
  std::uint64_t its = usual;
  std::thread([&] {
    comeForward();
    its = slice();
  }).join();
  EXPECT_LT(its, usual);
  EXPECT_EQ(slice(), usual);
}

}  // namespace
}  // namespace ortung::server

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "Await.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

using std::chrono::steady_clock;
using test::comesTrue;

TEST(Workers, DoEachPieceOnce) {
  for (const unsigned threads : {1u, 2u, 5u}) {
    std::vector<std::atomic<int>> done(1000);
    Workers workers(threads);
    for (std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{2}, done.size()}) {
      for (auto& each : done) each = 0;
      workers.run(n, [&](std::size_t i) { ++done[i]; });
      for (std::size_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i], i < n ? 1 : 0) << i;
    }
  }
}

TEST(Workers, AreWaitedForByWhoHasNothingMoreToDo) {
  std::atomic<int> begun{0};
  std::atomic<int> done{0};
  const auto caller = std::this_thread::get_id();
  Workers workers(2);
  for (int round = 1; round <= 3; ++round) {
    begun = done = 0;
    workers.run(2, [&](std::size_t) {
      if (std::this_thread::get_id() == caller) {  // leaves the other piece to the other thread
        EXPECT_TRUE(comesTrue("the other thread has begun", [&] { return begun > 0; }));
      } else {
        ++begun;
        const auto end = steady_clock::now() + std::chrono::milliseconds(20);
        while (steady_clock::now() < end) std::this_thread::yield();
      }
      ++done;
    });
    ASSERT_EQ(done, 2) << round;
  }
}

// A process that is forked has none of the threads: it makes some of its own, and waits for none.
TEST(Workers, WorkInAProcessThatIsForked) {
  std::vector<std::atomic<int>> done(100);
  const auto work = [&](Workers& workers) {
    for (auto& each : done) each = 0;
    workers.run(done.size(), [&](std::size_t i) { ++done[i]; });
    return std::all_of(done.begin(), done.end(), [](const auto& each) { return each == 1; });
  };
  auto workers = std::make_unique<Workers>(3);
  auto unused = std::make_unique<Workers>(3);  // by the child
  // All threads have begun before the fork: one that is just being made may hold a lock of the
  // address sanitizer, which the child would have for ever.
  EXPECT_TRUE(work(*workers));
  EXPECT_TRUE(work(*unused));
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::alarm(60);  // ends it if it waits for ever
    bool isRight = work(*workers);
    isRight = work(*workers) && isRight;
    workers.reset();
    unused.reset();
    ::_exit(isRight ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(work(*workers));
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

using std::chrono::steady_clock;

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
        while (begun == 0) std::this_thread::yield();
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

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <limits>
#include <thread>
#include <vector>

#include "Await.hpp"
#include "Files.hpp"
#include "PluginProgress.hpp"
#include "ProcessorWaits.hpp"
#include "ortung/core/PluginGuard.hpp"

namespace ortung {
namespace {

using test::comesTrue;
using test::messageOf;

/// What a watch said, if it said something within a minute.
std::string wait(std::future<std::string> told) {
  return told.wait_for(std::chrono::seconds(60)) == std::future_status::ready ? told.get()
                                                                              : "(nothing)";
}

TEST(PluginGuard, NamesWhoFailedInWhat) {
  const PluginGuard guard("the drive plugin 'x' of robot bob");
  EXPECT_EQ(messageOf<PluginFailure>(
                [&] { guard("measure", [] { throw std::runtime_error("a wheel came off"); }); }),
            "the drive plugin 'x' of robot bob failed in measure: a wheel came off");
  EXPECT_EQ(messageOf<PluginFailure>([&] { guard("measure", [] { throw 7; }); }),
            "the drive plugin 'x' of robot bob failed in measure: it threw no std::exception");
  EXPECT_EQ(messageOf<PluginFailure>([&] { guard.fail("limits", "it gave -1"); }),
            "the drive plugin 'x' of robot bob failed in limits: it gave -1");
  EXPECT_EQ(guard("measure", [] { return 4; }), 4);
}

TEST(PluginWatch, TellsOfACallThatDoesNotEnd) {
  const PluginGuard guard("the sensor plugin 'slow'");
  std::promise<std::string> told;
  const PluginWatch watch(0.05, [&](const std::string& late) { told.set_value(late); });
  std::promise<void> goOn;
  std::thread plugin([&] { guard("generateData", [&] { goOn.get_future().wait(); }); });
  const std::string said = wait(told.get_future());
  goOn.set_value();
  plugin.join();
  EXPECT_TRUE(said.starts_with("the sensor plugin 'slow' has been in generateData for ")) << said;
}

/// A call that takes long is told; many short ones of the same plugin are not, however long they
/// take together, though each time the watch looks it may find one under way.
TEST(PluginWatch, IsNotToldOfManyShortCalls) {
  constexpr double kBudget = 0.5;  // [s]: a short call must not take that long on a busy machine
  const PluginGuard busy("busy");
  const PluginGuard slow("slow");
  std::promise<std::string> told;
  std::atomic<bool> isTold = false;
  const PluginWatch watch(kBudget, [&](const std::string& late) {
    isTold = true;
    told.set_value(late);
  });
  std::thread plugin([&] {
    slow("learn",
         [&] { EXPECT_TRUE(comesTrue("the long call is told", [&] { return isTold.load(); })); });
  });
  EXPECT_TRUE(comesTrue("the long call is told", [&] {
    busy("generateData", [] {});
    return isTold.load();
  }));
  plugin.join();
  EXPECT_EQ(wait(told.get_future()).substr(0, 22), "slow has been in learn");
}

TEST(PluginWatch, SeesThroughExceptionsThatACallIsOver) {
  const PluginGuard thrower("thrower");
  const PluginGuard slow("slow");
  for (int i = 0; i < 3; ++i) EXPECT_THROW(thrower("take", [] { throw 1; }), PluginFailure);
  std::promise<std::string> told;
  std::promise<void> goOn;
  const PluginWatch watch(0.05, [&](const std::string& late) { told.set_value(late); });
  std::thread plugin([&] { slow("take", [&] { goOn.get_future().wait(); }); });
  EXPECT_TRUE(wait(told.get_future()).starts_with("slow "));
  goOn.set_value();
  plugin.join();
}

TEST(PluginWatch, IsNotToldOfALongCallThatSaysThatItGoesOn) {
  using Clock = std::chrono::steady_clock;
  constexpr double kBudget = 0.3;  // [s]
  const PluginGuard learner("learner");
  std::atomic<bool> isTold = false;
  const PluginWatch watch(kBudget, [&](const std::string&) { isTold = true; });
  learner("endLearning", [&] {
    const auto end = Clock::now() + std::chrono::duration<double>(4.0 * kBudget);
    while (Clock::now() < end) notePluginProgress();
  });
  EXPECT_FALSE(isTold);
}

// Four times as many threads as processors: some are always ready to run, and do not.
TEST(ProcessorWaits, AreThoseOfThreadsThatOthersHoldUp) {
  std::atomic<bool> isOver = false;
  std::vector<std::thread> busy;
  for (unsigned i = 0; i < 4 * std::max(1u, std::thread::hardware_concurrency()); ++i)
    busy.emplace_back([&] {
      while (!isOver) {
      }
    });
  ProcessorWaits waits;
  EXPECT_EQ(waits.sinceLast(), 0.0) << "there was no call before";
  double waited = 0.0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (waited < 0.01 && std::chrono::steady_clock::now() < end) waited += waits.sinceLast();
  isOver = true;
  for (std::thread& thread : busy) thread.join();
  EXPECT_GE(waited, 0.01);
  waits.forget();
  EXPECT_EQ(waits.sinceLast(), 0.0);
}

TEST(PluginWatch, RefusesTimesThatAreNone) {
  for (const double seconds :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(PluginWatch(seconds, {}), std::invalid_argument);
  const PluginWatch none(0.0, {});  // no limit
}

}  // namespace
}  // namespace ortung

#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

namespace ortung::test {

/// Waits until something comes true, asking again and again: for longer than any busy computer
/// needs, but not for ever, so that a test that fails says what it was waiting for.
/// @param what a statement that is to come true: "no client is left"
[[nodiscard]] inline testing::AssertionResult comesTrue(const std::string& what,
                                                        const std::function<bool()>& isTrue) {
  using std::chrono::steady_clock;
  constexpr std::chrono::seconds kLongestWait{60};
  const auto end = steady_clock::now() + kLongestWait;
  while (!isTrue()) {
    if (steady_clock::now() > end)
      return testing::AssertionFailure()
             << "waited for " << kLongestWait.count() << " s in vain until " << what;
    std::this_thread::yield();
  }
  return testing::AssertionSuccess();
}

}  // namespace ortung::test

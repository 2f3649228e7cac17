#pragma once

#include <gtest/gtest.h>

#include "ortung/sim/SceneRun.hpp"

namespace ortung::test {

/// Goes on until no player plays any more, which takes some seconds of the scene's time.
inline void playToTheEnd(SceneRun& run) {
  constexpr Timestamp kLatest = 60'000'000;
  while (!run.players().isEmpty() && run.simulation().now() < kLatest) run.step();
  EXPECT_TRUE(run.players().isEmpty()) << "somebody plays for ever";
}

}  // namespace ortung::test

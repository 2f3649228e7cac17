// A world whose cycle does not come back: clients are told before the program ends.
#include <gtest/gtest.h>

#include <atomic>
#include <semaphore>
#include <thread>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "TestClient.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace ortung::test {
namespace {

/// Once it is told to, a cycle takes as long as the test wants.
class HangingWorld final : public CountingWorld {
 public:
  void step() override {
    if (shallHang.exchange(false)) {
      hangs.release();
      goesOn.acquire();
    }
    CountingWorld::step();
  }
  std::atomic<bool> shallHang{false};
  std::binary_semaphore hangs{0};
  std::binary_semaphore goesOn{0};
};

TEST(Abandon, TellsAllClientsWhyAlthoughTheWorldHangs) {
  HangingWorld world;
  MessageBoard board(world, {});
  std::thread serving([&] { board.run(); });
  TestClient idle(board.port());
  TestClient subscriber(board.port());
  EXPECT_TRUE(idle.ask("HELLO ortung/1").starts_with("OK HELLO"));
  subscriber.join(kAnyRobot);
  EXPECT_TRUE(subscriber.ask("SUBSCRIBE counter/*/*").starts_with("OK SUBSCRIBE"));
  world.shallHang = true;
  world.hangs.acquire();
  // A call waits for a second, which a busy machine may take.
  EXPECT_TRUE(comesTrue("all are told within a second",
                        [&] { return board.abandon("the server ends, it hangs"); }));
  EXPECT_EQ(idle.line(), "* BYE the server ends, it hangs");
  EXPECT_EQ(idle.line(), "(closed)");
  EXPECT_EQ(subscriber.lineWith("BYE"), "* BYE the server ends, it hangs");
  world.goesOn.release();  // a program that is abandoned would end instead
  board.stop();
  serving.join();
}

TEST(Abandon, WithoutARunItSaysThatNobodyWasTold) {
  CountingWorld world;
  MessageBoard board(world, {});
  EXPECT_FALSE(board.abandon("nobody hears it"));
}

}  // namespace
}  // namespace ortung::test

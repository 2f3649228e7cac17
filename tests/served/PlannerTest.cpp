// Floor plans: robots of clients come in all sizes, one after the other.
#include <gtest/gtest.h>

#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

/// Creates a robot of its own size. @param place "" for anywhere
std::string create(TestClient& client, int size, const std::string& drive = "") {
  client.send("CREATE r" + std::to_string(size) + " " + drive + "\n[robot]\nradius_m = 0." +
              std::to_string(100 + size) + "\n[[sensor]]\nplugin = \"odometry\"\n");
  return client.ask(".");
}

TEST(Planners, SizesThatHaveLeftCountForNothing) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  for (const std::string drive : {"", "drive=wander"}) {
    for (int size = 0; size < 20; ++size) {
      const std::string reply = create(client, size, drive);
      ASSERT_TRUE(reply.starts_with("OK CREATE")) << size << ": " << reply;
      EXPECT_EQ(client.ask("REMOVE"), "OK REMOVE");
    }
  }
}

TEST(Planners, WhoIsOnlyPlacedFindsRoomAlthoughAllPlansAreWanderedBy) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, controlledConfig());
  TestClient wanderers[2] = {TestClient(board.port()), TestClient(board.port())};
  for (int i = 0; i < 8; ++i) {
    TestClient& client = wanderers[i / 4];
    if (i % 4 == 0) client.ask("HELLO ortung/1");
    ASSERT_TRUE(create(client, i, "drive=wander").starts_with("OK CREATE")) << i;
  }
  TestClient honest(board.port());
  honest.ask("HELLO ortung/1");
  EXPECT_EQ(create(honest, 10, "drive=wander"),
            "ERR limit robots of 8 different sizes wander here already; do not ask for wandering");
  EXPECT_TRUE(create(honest, 10).starts_with("OK CREATE"));
  EXPECT_TRUE(create(honest, 11).starts_with("OK CREATE"));
  EXPECT_TRUE(create(honest, 3, "drive=wander").starts_with("OK CREATE"));  // a size that is there
  // The world goes on with all of them, also after it has started over.
  honest.ask("LOCKSTEP on");
  EXPECT_TRUE(honest.ask("NEXT cycles=200 none/none/none").starts_with("OK NEXT"));
  EXPECT_TRUE(honest.ask("RESET").starts_with("OK RESET"));
  EXPECT_TRUE(honest.ask("NEXT cycles=200 none/none/none").starts_with("OK NEXT"));
  // A place is free again when a wanderer has left.
  EXPECT_EQ(wanderers[0].lineWith("OK REMOVE", "REMOVE\n"), "OK REMOVE");
  EXPECT_TRUE(create(honest, 12, "drive=wander").starts_with("OK CREATE"));
}

}  // namespace
}  // namespace ortung::test

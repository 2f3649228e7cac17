// Cameras of robots on a server draw for whoever asks.
#include <gtest/gtest.h>

#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

/// How many readings a NEXT gives. @param query what it asks for
int readingsOf(TestClient& client, int cycles, const std::string& query) {
  const std::string reply = client.ask("NEXT cycles=" + std::to_string(cycles) + " " + query);
  const int lines = std::stoi("0" + valueOf(reply, "lines"));
  for (int i = 0; i < lines; ++i) client.line();
  return lines;
}

TEST(ServedCamera, DrawsFromTheFirstRequestForItsPicturesOn) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  ASSERT_TRUE(client
                  .join("[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n[[sensor]]\n"
                        "plugin = \"camera\"\n[sensor.camera]\nsize_px = [16, 12]\n"
                        "focal_px = [10.0, 10.0]\n")
                  .starts_with("OK CREATE"));
  client.ask("LOCKSTEP on");
  EXPECT_EQ(readingsOf(client, 30, "odometry/*/*"), 1);
  EXPECT_EQ(readingsOf(client, 1, "camera/*/*"), 0);  // nobody had asked before
  EXPECT_EQ(readingsOf(client, 30, "camera/*/*"), 1);
  EXPECT_EQ(readingsOf(client, 30, "camera/*/*"), 1);
}

}  // namespace
}  // namespace ortung::test

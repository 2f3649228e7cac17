// Records of a served simulation hold what its clients were given.
#include <gtest/gtest.h>

#include "Files.hpp"
#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/core/BinaryReading.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/RecordedWorld.hpp"

namespace ortung::test {
namespace {

const std::string kScout = R"([robot]
radius_m = 0.2
[[sensor]]
plugin = "odometry"
[[sensor]]
plugin = "lrf"
beams = 31
)";

TEST(RecordedSimulation, GivesTheWordsThatClientsWereGivenWithTheTruth) {
  const TemporaryFolder folder;
  ServedSimulation simulation(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.seed = 4});
  Recordings recordings({.folder = folder.path()});
  RecordedWorld world(simulation, recordings, {});
  BoardConfig config = controlledConfig();
  config.commands = {recordCommand(world)};
  const RunningBoard board(world, config);
  TestClient client(board.port());
  ASSERT_TRUE(client.join(kScout, "anna", "drive=wander", "scout").starts_with("OK CREATE"));
  client.ask("LOCKSTEP on");
  client.ask("RECORD robot=1 on");
  std::vector<std::string> served;
  for (int i = 0; i < 300; ++i) {
    const int count = std::stoi(valueOf(client.ask("NEXT"), "lines"));
    for (int left = count; left > 0; --left) served.push_back(client.line());
  }
  EXPECT_TRUE(client.ask("RECORD robot=1 off")
                  .starts_with("OK RECORD robot=1 state=off file=scout-1.rec moments="));

  RecordSource record(folder / "scout-1.rec");
  EXPECT_EQ(record.worldFingerprint(), simulation.describe().fingerprint);
  std::vector<std::string> recorded;
  bool hasTruth = false;
  for (Message message; record.next(message);) {
    recorded.emplace_back();
    writeLine(message, recorded.back());
    hasTruth = hasTruth || message.id.type == "groundTruth";
  }
  EXPECT_TRUE(hasTruth);
  EXPECT_EQ(recorded, served);
  EXPECT_GT(recorded.size(), 100u);
}

TEST(RecordedSimulation, TakesPicturesThatNoClientAsksFor) {
  const TemporaryFolder folder;
  ServedSimulation simulation(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {});
  Recordings recordings({.folder = folder.path()});
  RecordedWorld world(simulation, recordings, {});
  BoardConfig config = controlledConfig();
  config.commands = {recordCommand(world)};
  const RunningBoard board(world, config);
  TestClient client(board.port());
  const std::string camera =
      "[[sensor]]\nplugin = \"camera\"\n[sensor.camera]\nsize_px = [32, 24]\nfocal_px = [20.0, "
      "20.0]\n";
  const std::string joined = client.join(camera, "anna", "", "scout");
  ASSERT_TRUE(joined.starts_with("OK CREATE")) << joined;
  client.ask("LOCKSTEP on");
  client.ask("RECORD robot=1 on");
  client.ask("NEXT cycles=40 */groundTruth/*");
  client.line();
  client.ask("RECORD robot=1 off");
  std::size_t pictures = 0;
  RecordSource record(folder / "scout-1.rec");
  for (Message message; record.next(message);)
    if (message.id.model == "camera") ++pictures;
  EXPECT_GT(pictures, 1u);
}

}  // namespace
}  // namespace ortung::test

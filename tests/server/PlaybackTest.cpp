// Records with a time line, as clients see them.
#include <gtest/gtest.h>

#include <map>

#include "Files.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/TalkData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::test {
namespace {

constexpr Timestamp kBegin = 1'700'000'000'000'000;  // stamps of a robot's own clock
const SensorId kTruth{"reference", "groundTruth", "pose"};
const SensorId kCount{"counter", "counter", "cycle"};
const SensorId kTrack{"mcl", "LOCALIZATION", "status"};

/// Ten seconds at 10 Hz: a robot that drives 1 m/s along x from x0 on, and is put to (x0, 5) after
/// 6 s. Every second it counts; it tracks from 1 s on and is lost from 6.5 to 8 s.
void writeRun(const std::filesystem::path& file, double x0) {
  RecordWriter record(file, "0123456789abcdef");
  for (std::uint32_t i = 0; i <= 100; ++i) {
    const Timestamp stamp = kBegin + i * 100'000;
    const double x = x0 + 0.1 * (i < 60 ? i : i - 60);
    record.write({stamp, kTruth, PoseData::encode({x, i < 60 ? 0.0 : 5.0, 0.5})});
    if (i % 10 == 0) record.write({stamp, kCount, {i / 10}});
    const std::uint32_t status = i < 10 ? 2u : i >= 65 && i < 80 ? 2u : 0u;
    record.write({stamp, kTrack, {status, 0, 9000, 10000}});
    if (i == 30)
      record.write({stamp,
                    {"referee", "referee", "events"},
                    TalkData::encode({"", {{0.0, "referee", "goal for blue"}}})});
    record.endMoment();
  }
  record.commit();
}

struct Playback {
  TemporaryFolder folder;
  ServedPlayback::Config config;
  Playback() {
    writeRun(folder / "a.rec", 0.0);
    writeRun(folder / "b.rec", -3.0);
    config.name = "both";
    config.runs = {{folder / "a.rec", "a"}, {folder / "b.rec", "b"}};
  }
};

double metres(const std::string& line, int word) {
  std::istringstream in(line);
  std::string skipped;
  for (int i = 0; i < 3 + word; ++i) in >> skipped;
  double value = 0.0;
  in >> value;
  return (value - 2147483648.0) / 1000.0;
}

TEST(Playback, KnowsFormatsByNamesThatAreAlwaysTheSameOrAsItIsTold) {
  const TemporaryFolder folder;
  const std::vector<std::pair<SensorId, std::string>> known{
      {kTruth, "pose"},
      {{"odometry", "odometry", "pose"}, "odometry"},
      {{"mcl", "LOCALIZATION", "pose"}, "fix"},
      {{"mcl", "LOCALIZATION", "smooth"}, "pose"},
      {{"mcl", "LOCALIZATION", "protection"}, "protection"},
      {{"mcl", "LOCALIZATION", "places"}, "clusters"},
      {{"mcl", "LOCALIZATION", "samples"}, "samples"},
      {{"mcl", "LOCALIZATION", "work"}, "work"},
      {kCount, "counted row=identity"},  // the one that is told
      {{"laser", "LRF", "scan"}, ""}};
  RecordWriter record(folder / "a.rec", "0123456789abcdef");
  for (const auto& [id, format] : known) record.write({kBegin, id, {}});
  record.endMoment();
  record.commit();
  const ServedPlayback world(
      {.name = "one",
       .runs = {{folder / "a.rec", "a", {{kCount, "for people", {}, "counted row=identity"}}}}});
  const std::vector<ServedFeature> features = world.residents().at(0).features;
  ASSERT_EQ(features.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_EQ(features[i].id, known[i].first);
    EXPECT_EQ(features[i].format, known[i].second);
  }
}

TEST(Playback, GoesToAnyTimeAndShowsWhatWasNewestThere) {
  Playback two;
  ServedPlayback world(two.config);
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  EXPECT_NE(client.ask("HELLO ortung/1").find("kind=record world=both"), std::string::npos);
  client.ask("DESCRIBE world");
  const std::string described = client.line();
  EXPECT_EQ(valueOf(described, "end_us"), "10000000");
  EXPECT_EQ(valueOf(described, "x_min_m"), "-4");
  for (const double time : {4.0, 9.05, 0.0, 2.55, 10.0}) {
    const auto stamp = std::to_string(fromSeconds(time));
    EXPECT_EQ(client.ask("SEEK time_s=" + std::to_string(time)), "OK SEEK now=" + stamp);
    const double now = std::floor(time * 10 + 1e-9) / 10;  // the newest reading
    const double x = now < 6 ? now : now - 6;
    client.ask("READ robot=1 reference/*/*");
    EXPECT_NEAR(metres(client.line(), 0), x, 6e-4) << time;
    client.ask("READ robot=2 reference/*/*");
    EXPECT_NEAR(metres(client.line(), 0), x - 3, 6e-4) << time;
    client.ask("READ robot=1 counter/*/*");
    const std::string count = client.line();
    EXPECT_EQ(count.substr(count.rfind(' ') + 1), std::to_string(static_cast<int>(time + 1e-9)));
    client.ask("READ robot=0");
    EXPECT_NEAR(metres(client.line(), 1), x, 6e-4) << "the first robot of the truth, at " << time;
  }
}

TEST(Playback, PlaysOnFromWhereItWasSetTo) {
  Playback two;
  ServedPlayback world(two.config);
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  client.ask("PAUSE");
  client.ask("SEEK time_s=3.01");
  EXPECT_EQ(client.ask("STEP cycles=10"), "OK STEP");  // of 20 ms
  client.ask("READ robot=1 reference/*/*");
  const std::string line = client.line();
  EXPECT_EQ(line.substr(0, line.find(' ')), "3200000");
  EXPECT_EQ(client.ask("SEEK time_s=9.99"), "OK SEEK now=9990000");
  client.ask("STEP cycles=5");
  EXPECT_EQ(valueOf(client.ask("STATUS"), "state"), "ended");
  EXPECT_EQ(client.ask("STEP").substr(0, 7), "ERR end");
  EXPECT_EQ(client.ask("SEEK time_s=1e6"), "OK SEEK now=10000000");
  client.ask("SEEK time_s=0");
  EXPECT_EQ(valueOf(client.ask("STATUS"), "state"), "paused");
}

TEST(Playback, MarksWhatHappened) {
  Playback two;
  two.config.runs.resize(1);
  const ServedPlayback world(two.config);
  std::vector<std::string> marks;
  for (const ServedPlayback::Mark& mark : world.marks())
    marks.push_back(std::to_string(mark.stamp / 100'000) + " " + mark.text);
  EXPECT_EQ(marks,
            (std::vector<std::string>{"10 a: tracking", "30 a: goal for blue", "60 a: carried away",
                                      "65 a: lost: readings fit", "80 a: tracking"}));
}

// A filter that wavers, and small corrections, are no events; being uncertain for a while is, with
// its reason.
TEST(Playback, MarksHowLongAFilterIsUncertainAndWhy) {
  const TemporaryFolder folder;
  RecordWriter record(folder / "run.rec", "0123456789abcdef");
  TrackData::Reading told;
  const auto write = [&](double seconds, TrackStatus status, TrackReason reason) {
    told.status = status;
    told.reason = reason;
    record.write(TrackData::message(fromSeconds(seconds), told));
  };
  write(0.0, TrackStatus::kUncertain, TrackReason::kSpread);
  write(5.0, TrackStatus::kTracking, TrackReason::kFits);
  write(6.0, TrackStatus::kUncertain, TrackReason::kRival);
  write(6.9, TrackStatus::kUncertain, TrackReason::kRival);
  told.relocalizations = 1;
  told.relocalization = Relocalization::kReadings;
  write(7.0, TrackStatus::kTracking, TrackReason::kFits);
  write(8.0, TrackStatus::kUncertain, TrackReason::kOdometry);
  for (const double seconds : {9.0, 9.5, 11.0})
    write(seconds, TrackStatus::kUncertain, TrackReason::kOdometry);
  told.relocalizations = 2;
  told.relocalization = Relocalization::kOtherPlace;
  write(12.0, TrackStatus::kTracking, TrackReason::kFits);
  record.commit();
  ServedPlayback::Config config;
  config.runs = {{folder / "run.rec", "a"}};
  const ServedPlayback world(config);
  std::vector<std::string> marks;
  for (const ServedPlayback::Mark& mark : world.marks())
    marks.push_back(std::to_string(mark.stamp / 1'000'000) + " " + mark.text);
  EXPECT_EQ(marks, (std::vector<std::string>{
                       "5 a: tracking", "9 a: uncertain: readings contradict odometry",
                       "12 a: relocalized: readings fit another place better", "12 a: tracking"}));
}

TEST(Playback, ChangesNothingThatHasHappened) {
  Playback two;
  ServedPlayback world(two.config);
  BoardConfig config = controlledConfig();
  config.commands = playbackCommands(world);
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  for (const char* request :
       {"PLACE robot=1 x_m=0 y_m=0", "VELOCITY v_m_s=1 robot=1", "PLACE object=ball x_m=0 y_m=0"})
    EXPECT_TRUE(client.ask(request).starts_with("ERR record")) << request;
  EXPECT_TRUE(client.ask("CREATE r\n[[sensor]]\nplugin = \"odometry\"\n.").starts_with("ERR "));
  for (const char* request : {"SEEK", "SEEK time_s=-1", "SEEK time_s=nan", "EVENTS since=x"})
    EXPECT_TRUE(client.ask(request).starts_with("ERR ")) << request;
  EXPECT_TRUE(client.ask("EVENTS since=9").starts_with("OK EVENTS next=10 lines=1"));
}

/// The lines of a reply.
std::vector<std::string> linesOf(TestClient& client, const std::string& request) {
  const std::string reply = client.ask(request);
  EXPECT_TRUE(reply.starts_with("OK ")) << request << ": " << reply;
  const std::string count = valueOf(reply, "lines");
  std::vector<std::string> lines(count.empty() ? 0 : std::stoul(count));
  for (std::string& line : lines) line = client.line();
  return lines;
}

TEST(Playback, TellsWhatItHoldsAndReadingsOfAllOfIt) {
  Playback two;
  ServedPlayback world(two.config);
  BoardConfig config = controlledConfig();
  config.commands = playbackCommands(world);
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  EXPECT_EQ(linesOf(client, "CONTENTS robot=2"),
            (std::vector<std::string>{
                "reference/groundTruth/pose readings=101 first_us=0 last_us=10000000",
                "counter/counter/cycle readings=11 first_us=0 last_us=10000000",
                "mcl/LOCALIZATION/status readings=101 first_us=0 last_us=10000000",
                "referee/referee/events readings=1 first_us=3000000 last_us=3000000"}));
  const std::vector<std::string> counts = linesOf(client, "HISTORY robot=1 counter/*/*");
  ASSERT_EQ(counts.size(), 11U) << "all there are, wherever the time line is";
  for (std::size_t i = 0; i < counts.size(); ++i)
    EXPECT_EQ(counts[i],
              std::to_string(i * 1'000'000) + " counter/counter/cycle 1 " + std::to_string(i));
  const auto few = linesOf(client, "HISTORY robot=2 reference/*/* counter/*/* most=5");
  std::vector<double> xs;
  std::size_t others = 0;
  for (const std::string& line : few) {
    if (line.find("groundTruth") == line.npos)
      ++others;
    else
      xs.push_back(metres(line, 0));
  }
  EXPECT_EQ(others, 5U);
  ASSERT_EQ(xs.size(), 5U);
  EXPECT_NEAR(xs.back(), 1.0, 6e-4) << "the last one is among them: -3 m and 4 s of 1 m/s";
  EXPECT_EQ(linesOf(client, "HISTORY robot=1 no/such/feature").size(), 0U);
  for (const char* request : {"HISTORY robot=1", "HISTORY robot=3 */*/*", "HISTORY robot=0 */*/*",
                              "HISTORY robot=1 */*/* most=0", "HISTORY robot=1 */*/* most=1e9",
                              "HISTORY robot=1 words", "CONTENTS robot=9", "CONTENTS robot=1 x=1"})
    EXPECT_TRUE(client.ask(request).starts_with("ERR ")) << request;
}

TEST(Playback, HistoriesFitIntoAnAnswer) {
  const TemporaryFolder folder;
  const SensorId scan{"laser", "LRF", "scan"};
  {
    RecordWriter record(folder / "a.rec", "");
    for (std::uint32_t i = 0; i < 1000; ++i) {
      record.write({kBegin + i * 1000, kCount, {i}});
      record.write({kBegin + i * 1000, scan, std::vector<std::uint32_t>(181, 100'000 + i)});
      record.endMoment();
    }
    record.commit();
  }
  ServedPlayback world({.name = "one", .runs = {{folder / "a.rec", "a"}}});
  BoardConfig config = controlledConfig();
  config.commands = playbackCommands(world);
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  std::map<std::string, std::size_t> count;
  std::size_t bytes = 0;
  std::string last;
  for (const std::string& line : linesOf(client, "HISTORY */*/*")) {
    bytes += line.size() + 1;
    ++count[line.find("LRF") == line.npos ? "counts" : "scans"];
    last = line;
  }
  EXPECT_LE(bytes, 512U << 10);
  EXPECT_GT(bytes, 256U << 10);
  EXPECT_EQ(count["counts"], count["scans"]) << "none of the features is left out for another";
  EXPECT_EQ(last.substr(0, 6), "999000");
}

TEST(Playback, WithoutTruthItsFieldIsWhereOdometryWas) {
  const TemporaryFolder folder;
  RecordWriter record(folder / "a.rec", "");
  for (std::uint32_t i = 0; i <= 20; ++i) {
    OdometryData::Reading reading;
    reading.pose = {0.5 * i, -0.25 * i, 0.0};
    record.write(
        {kBegin + i * 100'000, {"odometry", "odometry", "pose"}, OdometryData::encode(reading)});
    record.endMoment();
  }
  record.commit();
  const ServedPlayback world({.name = "one", .runs = {{folder / "a.rec", "a"}}});
  const auto bounds = world.describe().bounds;
  ASSERT_TRUE(bounds);
  EXPECT_NEAR(bounds->xMin, -5.0, 1e-9) << "what a scanner sees around it, too: 5 m";
  EXPECT_NEAR(bounds->xMax, 15.0, 1e-9);
  EXPECT_NEAR(bounds->yMin, -10.0, 1e-9);
  EXPECT_NEAR(bounds->yMax, 5.0, 1e-9);
}

TEST(Playback, OfWhatIsNoRecordIsRefused) {
  const TemporaryFolder folder;
  writeBytes(folder / "x.rec", "no record\n");
  ServedPlayback::Config config;
  config.runs = {{folder / "x.rec", "x"}};
  EXPECT_THROW(ServedPlayback{config}, std::runtime_error);
  config.runs = {};
  EXPECT_THROW(ServedPlayback{config}, std::invalid_argument);
  config.runs = {{folder / "x.rec", "two words"}};
  EXPECT_THROW(ServedPlayback{config}, std::invalid_argument);
}

}  // namespace
}  // namespace ortung::test

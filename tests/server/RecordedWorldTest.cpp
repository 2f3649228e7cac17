// Records that clients begin and end.
#include <gtest/gtest.h>

#include "CountingWorld.hpp"
#include "Files.hpp"
#include "ProtocolPage.hpp"
#include "RunningBoard.hpp"
#include "SmallFiles.hpp"
#include "TestClient.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/server/RecordedWorld.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> linesOf(const fs::path& file) {
  RecordSource source(file);
  std::vector<std::string> lines;
  std::string line;
  for (Message message; source.next(message); lines.push_back(line)) {
    line.clear();
    writeLine(message, line);
  }
  return lines;
}

/// A world on a board, and an operator in lockstep with a robot.
struct RecordedBoard {
  explicit RecordedBoard(std::size_t imageWords = 0, fs::path into = "records")
      : counting(imageWords),
        recordings({.folder = into.empty() ? into : folder / into.string(),
                    .onProblem = [this](const std::string& text) { problems.push_back(text); }}),
        world(counting, recordings, {}),
        board(world,
              [this] {
                BoardConfig config = controlledConfig();
                config.commands = {recordCommand(world)};
                return config;
              }()),
        client(board.port()) {
    client.join(kAnyRobot, "anna", "", "scout");
    client.ask("LOCKSTEP on");
  }
  /// Lets the world go on. @returns the readings of the first robot
  std::vector<std::string> next(int cycles) {
    std::vector<std::string> lines;
    for (int i = 0; i < cycles; ++i) {
      const int count = std::stoi(valueOf(client.ask("NEXT counter/*/*"), "lines"));
      for (int left = count; left > 0; --left) lines.push_back(client.line());
    }
    return lines;
  }
  std::string robots() {
    client.ask("LIST robots");
    return client.line();
  }

  TemporaryFolder folder;
  std::vector<std::string> problems;
  CountingWorld counting;
  Recordings recordings;
  RecordedWorld world;
  RunningBoard board;
  TestClient client;
};

// However many files there are, a name is found at once: above the greatest number.
TEST(Recordings, NumbersFilesAboveThoseThatThereAre) {
  const TemporaryFolder folder;
  for (const char* file :
       {"scout-7.rec", "scout-12.rec", "scout-12.txt", "scout-x.rec", "scout-.rec", "scout-2.rec",
        "scout-99999999999.rec", "scout--3.rec", "other-50.rec"})
    writeBytes(folder / file, "not ours");
  Recordings recordings({.folder = folder / "", .onProblem = {}});
  const auto begun = [&](const std::string& name) {
    recordings.begin(1, name, "");
    std::string file = recordings.state(1).file;
    recordings.end(1);
    return file;
  };
  EXPECT_EQ(begun("scout"), "scout-13.rec");
  EXPECT_EQ(begun("scout"), "scout-14.rec");
  EXPECT_EQ(begun("scout-"), "scout--4.rec");
  for (int i = 15; i < 40; ++i)  // by another program meanwhile
    writeBytes(folder / ("scout-" + std::to_string(i) + ".rec"), "not ours");
  const std::string next = begun("scout");
  EXPECT_GE(std::stoi(next.substr(6)), 40) << next;
  EXPECT_EQ(readBytes(folder / "scout-12.rec"), "not ours");
}

TEST(Recordings, SayThatAFileIsGone) {
  const TemporaryFolder folder;
  Recordings recordings({.folder = folder / "", .onProblem = {}});
  recordings.begin(1, "scout", "");
  const std::vector<Message> moment{{10, {"a", "b", "c"}, {1}}};
  recordings.write(1, moment);
  fs::remove(folder / "scout-1.rec");
  recordings.begin(1, "scout", "");  // goes on
  EXPECT_EQ(messageOf<ServeError>([&] { recordings.end(1); }),
            "scout-1.rec is gone: it was removed or renamed while it was written");
  EXPECT_EQ(recordings.state(1).kind, Recordings::State::Kind::kFailed);
}

TEST(RecordedWorld, HoldsWhatWasServedBetweenOnAndOff) {
  RecordedBoard it;
  it.next(3);
  EXPECT_EQ(it.client.ask("RECORD"), "OK RECORD robot=1 state=off");
  EXPECT_EQ(it.client.ask("RECORD robot=1 on"),
            "OK RECORD robot=1 state=on file=scout-1.rec moments=0");
  EXPECT_EQ(it.robots(), "robot=1 name=scout client=1 record=scout-1.rec");
  const std::vector<std::string> served = it.next(5);
  ASSERT_EQ(served.size(), 5u);
  EXPECT_EQ(it.client.ask("RECORD robot=1 on"),
            "OK RECORD robot=1 state=on file=scout-1.rec moments=5");
  EXPECT_EQ(it.client.ask("RECORD robot=1 off"),
            "OK RECORD robot=1 state=off file=scout-1.rec moments=5");
  it.next(2);
  EXPECT_EQ(it.robots(), "robot=1 name=scout client=1");
  EXPECT_EQ(linesOf(it.folder / "records/scout-1.rec"), served);
  EXPECT_EQ(RecordSource(it.folder / "records/scout-1.rec").worldFingerprint(), "0123456789abcdef");
  EXPECT_EQ(it.client.ask("RECORD robot=1 off"),
            "OK RECORD robot=1 state=off file=scout-1.rec moments=5");
}

TEST(RecordedWorld, RecordsAllRobotsEachInAFileOfItsOwn) {
  RecordedBoard it;
  writeBytes(it.folder / "records/scout-1.rec", "of somebody else");
  it.client.send("CREATE scout\n" + kAnyRobot);
  EXPECT_TRUE(it.client.ask(".").starts_with("OK CREATE robot=2"));
  EXPECT_EQ(it.client.ask("RECORD robot=all on"), "OK RECORD robot=all lines=2");
  EXPECT_EQ(it.client.line(), "robot=1 state=on file=scout-2.rec moments=0");
  EXPECT_EQ(it.client.line(), "robot=2 state=on file=scout-3.rec moments=0");
  it.next(4);
  it.client.ask("REMOVE robot=2");  // which ends its record
  EXPECT_EQ(linesOf(it.folder / "records/scout-3.rec").size(), 4u);
  it.next(2);
  EXPECT_EQ(it.client.ask("RECORD robot=all off"), "OK RECORD robot=all lines=1");
  EXPECT_EQ(it.client.line(), "robot=1 state=off file=scout-2.rec moments=6");
  EXPECT_EQ(linesOf(it.folder / "records/scout-2.rec").size(), 6u);
  EXPECT_EQ(readBytes(it.folder / "records/scout-1.rec"), "of somebody else");
}

TEST(RecordedWorld, EndsRecordsWhereTimeStartsOver) {
  RecordedBoard it;
  it.client.ask("RECORD robot=1 on");
  it.next(3);
  EXPECT_TRUE(it.client.ask("RESET").starts_with("OK RESET"));
  EXPECT_EQ(it.client.ask("RECORD robot=1"),
            "OK RECORD robot=1 state=off file=scout-1.rec moments=3");
  it.client.ask("RECORD robot=1 on");
  it.next(2);
  it.client.ask("RECORD robot=1 off");
  EXPECT_EQ(linesOf(it.folder / "records/scout-2.rec").size(), 2u);
}

TEST(RecordedWorld, RefusesWhatCanNotBe) {
  RecordedBoard it;
  EXPECT_TRUE(it.client.ask("RECORD robot=7 on").starts_with("ERR no-robot "));
  EXPECT_TRUE(it.client.ask("RECORD robot=1 of").starts_with("ERR syntax "));
  EXPECT_TRUE(it.client.ask("RECORD robot=1 on off").starts_with("ERR syntax "));
  EXPECT_TRUE(it.client.ask("RECORD robot=some on").starts_with("ERR number "));
  EXPECT_TRUE(it.client.ask("RECORD robot=1 on file=/tmp/x").starts_with("ERR syntax "));
  TestClient viewer(it.board.port());
  viewer.ask("HELLO ortung/1 name=look role=viewer");
  EXPECT_TRUE(viewer.ask("RECORD robot=1 on").starts_with("ERR role "));
  EXPECT_EQ(viewer.ask("RECORD robot=1"), "OK RECORD robot=1 state=off");
  EXPECT_EQ(it.folder.files(), 1u);  // the folder of records, which was made
  EXPECT_TRUE(fs::is_empty(it.folder / "records"));
}

TEST(RecordedWorld, SaysWhatTheServerMustBeStartedWith) {
  RecordedBoard it(0, "");
  const std::string reply = it.client.ask("RECORD robot=1 on");
  EXPECT_TRUE(reply.starts_with("ERR state ")) << reply;
  EXPECT_NE(reply.find("--record-into FOLDER"), std::string::npos) << reply;
}

TEST(RecordedWorld, SaysThatTheDiskIsFullAndGoesOn) {
  RecordedBoard it(100'000);
  it.client.ask("RECORD robot=1 on");
  {
    const SmallFiles small(3000);
    it.next(400);  // 4 s: a chunk each second
  }
  const std::string state = it.client.ask("RECORD robot=1");
  EXPECT_TRUE(state.starts_with("OK RECORD robot=1 state=failed file=scout-1.rec moments="));
  EXPECT_NE(state.find("File too large"), std::string::npos) << state;
  EXPECT_EQ(it.robots(), "robot=1 name=scout client=1 record=failed");
  ASSERT_EQ(it.problems.size(), 1u);
  EXPECT_NE(it.problems.front().find("scout-1.rec"), std::string::npos);
  EXPECT_NO_THROW(linesOf(it.folder / "records/scout-1.rec"));  // what is whole
  EXPECT_TRUE(it.client.ask("RECORD robot=1 on").ends_with("file=scout-2.rec moments=0"));
}

TEST(RecordedWorld, HasTheCommandOfThePage) {
  CountingWorld counting;
  Recordings recordings({.folder = {}});
  RecordedWorld world(counting, recordings, {});
  expectDocumented("Recording", {recordCommand(world)});
}

TEST(Recordings, MakesNamesThatNoFileSystemMinds) {
  const TemporaryFolder folder;
  Recordings recordings({.folder = folder.path()});
  recordings.begin(1, "../../etc/passwd", "");
  recordings.begin(2, "", "");
  recordings.begin(3, "-rf", "");
  recordings.begin(4, "Grün 1", "");
  EXPECT_EQ(recordings.state(1).file, "______etc_passwd-1.rec");
  EXPECT_EQ(recordings.state(2).file, "robot-1.rec");
  EXPECT_EQ(recordings.state(3).file, "_rf-1.rec");
  EXPECT_EQ(recordings.state(4).file, "Gr__n_1-1.rec");
  EXPECT_EQ(folder.files(), 4u);
}

TEST(Recordings, OpensNoMoreThanItMay) {
  const TemporaryFolder folder;
  Recordings recordings({.folder = folder.path(), .most = 2});
  recordings.begin(1, "a", "");
  recordings.begin(2, "b", "");
  EXPECT_THROW(recordings.begin(3, "c", ""), ServeError);
  recordings.end(1);
  recordings.begin(3, "c", "");
  EXPECT_EQ(recordings.endAll().size(), 2u);
}

TEST(Recordings, EndsARecordWhoseTimeGoesBack) {
  const TemporaryFolder folder;
  std::string problem;
  Recordings recordings(
      {.folder = folder.path(), .onProblem = [&](const std::string& text) { problem = text; }});
  recordings.begin(1, "a", "");
  const SensorId id{"m", "t", "f"};
  recordings.write(1, std::vector<Message>{{2'000'000, id, {1}}});
  recordings.write(1, std::vector<Message>{{1'000'000, id, {2}}});
  EXPECT_EQ(recordings.state(1).text,
            "the time of the readings went back, from 2000000 to 1000000 us");
  EXPECT_NE(problem.find("a-1.rec"), std::string::npos);
  EXPECT_EQ(linesOf(folder / "a-1.rec"), std::vector<std::string>{"2000000 m/t/f 1 1"});
}

TEST(Recordings, RefusesAFolderThatIsNone) {
  const TemporaryFolder folder;
  writeBytes(folder / "file", "x");
  EXPECT_THROW(Recordings({.folder = folder / "file" / "in"}), std::runtime_error);
  EXPECT_THROW(Recordings({.folder = folder / "file"}), std::runtime_error);
}

}  // namespace
}  // namespace ortung::test

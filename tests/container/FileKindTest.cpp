#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/base/FileKind.hpp"

namespace ortung {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = ORTUNG_SOURCE_DIR;

TEST(FileKind, KnowsTheFilesThatShip) {
  const auto expect = [](const char* folder, FileKind kind) {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(kSource / "maps" / folder)) {
      if (entry.path().extension() != ".toml") continue;
      EXPECT_EQ(kindOfFile(entry.path()), kind) << entry.path();
      ++count;
    }
    EXPECT_GT(count, 2u) << folder;
  };
  expect("fields", FileKind::kWorld);
  expect("robots", FileKind::kRobot);
  expect("scenes", FileKind::kScene);
}

TEST(FileKind, KnowsWhatTheProgramWrites) {
  const fs::path data = kSource / "tests/data";
  EXPECT_EQ(kindOfFile(data / "tables1.ortung"), FileKind::kTables);
  EXPECT_EQ(kindOfFile(data / "tables3.ortung"), FileKind::kTables);
  EXPECT_EQ(kindOfFile(data / "record1.rec"), FileKind::kRecord);
  EXPECT_EQ(kindOfFile(data / "record2.rec"), FileKind::kRecord);
  EXPECT_EQ(kindOfFile(data / "motion1.toml"), FileKind::kMotion);
  EXPECT_EQ(kindOfFile(data / "network1.json"), FileKind::kJson);
}

TEST(FileKind, KnowsFilesOfOthers) {
  EXPECT_EQ(kindOfBytes("image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"),
            FileKind::kMapServer);
  EXPECT_EQ(kindOfBytes("# message_name ...\nPARAM laser 1\n"), FileKind::kCarmenLog);
  EXPECT_EQ(kindOfBytes("FLASER 2 1.0 1.0 0 0 0 0 0 0 0 host 0\n"), FileKind::kCarmenLog);
  EXPECT_EQ(kindOfBytes("\x89MCAP0\r\n\x01"), FileKind::kMcap);
  EXPECT_EQ(kindOfBytes(std::string("SQLite format 3\0", 16)), FileKind::kSqlite);
  EXPECT_EQ(kindOfBytes("#ROSBAG V2.0\n"), FileKind::kRosBag);
  EXPECT_EQ(kindOfBytes("\x89PNG\r\n"), FileKind::kPicture);
  EXPECT_EQ(kindOfBytes("  <!DOCTYPE html>\n"), FileKind::kHtml);
  EXPECT_EQ(kindOfBytes("PK\x03\x04 word/document.xml"), FileKind::kZip);
  EXPECT_EQ(kindOfBytes("command = [\"ortung\"]\n[vary]\n"), FileKind::kSweep);
}

TEST(FileKind, WordsInCommentsAndTextsTellNothing) {
  EXPECT_EQ(kindOfBytes("# [scene]\nname = \"[robot]\"\n"), FileKind::kUnknown);
  EXPECT_EQ(kindOfBytes("[motion]\nplugin = \"odometry\"\n[robot]\n"), FileKind::kRobot);
}

TEST(FileKind, ReadsNoPipesAndNamesFolders) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(kindOfFile(folder.path()), FileKind::kFolder);
  std::ofstream(folder.path() / "metadata.yaml") << "rosbag2_bagfile_information:\n";
  EXPECT_EQ(kindOfFile(folder.path()), FileKind::kRosBagFolder);
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(kindOfFile(pipe), FileKind::kUnknown);  // and does not wait for a writer
  EXPECT_EQ(kindOfFile(folder.path() / "none"), FileKind::kUnknown);
}

TEST(FileKind, EveryKindHasAName) {
  for (int kind = 1; kind <= static_cast<int>(FileKind::kJson); ++kind)
    EXPECT_NE(nameOf(static_cast<FileKind>(kind)), "") << kind;
}

TEST(FileKind, SaysWhatWasGivenInstead) {
  const fs::path robot = kSource / "maps/robots/pioneer.toml";
  EXPECT_EQ(whatItIs(robot), "; it is a robot file (for --robot)");
  EXPECT_EQ(whatItIs(robot, {FileKind::kWorld, FileKind::kRobot}), "");
  EXPECT_EQ(whatItIs("/none"), "");
}

RC_GTEST_PROP(FileKind, AnyBytesHaveAKind, (const std::string& bytes)) {
  RC_ASSERT(static_cast<int>(kindOfBytes(bytes)) <= static_cast<int>(FileKind::kJson));
}

}  // namespace
}  // namespace ortung

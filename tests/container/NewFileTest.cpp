#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "Files.hpp"
#include "SmallFiles.hpp"
#include "ortung/base/NewFile.hpp"

namespace ortung {
namespace {

using test::messageOf;
using test::readBytes;
using test::SmallFiles;
using test::TemporaryFolder;

TEST(NewFile, ReplacesAFileWhenItIsWholeAndLeavesNothingElse) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a", "old");
  NewFile file(folder / "a");
  file.write("ne");
  file.write(std::span<const std::byte>());
  file.write(std::string(100000, 'w'));
  EXPECT_EQ(readBytes(folder / "a"), "old");
  file.commit();
  EXPECT_EQ(readBytes(folder / "a"), "ne" + std::string(100000, 'w'));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(NewFile, WithoutCommitTheOldFileStaysAndNothingElse) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a", "old");
  NewFile(folder / "a").write("new");
  EXPECT_EQ(readBytes(folder / "a"), "old");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(NewFile, NamesFileAndReason) {
  const TemporaryFolder folder;
  const auto missing = folder / "no" / "a";
  EXPECT_EQ(messageOf<std::runtime_error>([&] { NewFile{missing}; }),
            missing.string() + ": can't be written: No such file or directory");
  std::filesystem::create_directory(folder / "folder");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writeFile(folder / "folder", "x"); }),
            (folder / "folder").string() + ": can't be written: Is a directory");
  EXPECT_EQ(folder.files(), 1u) << "nothing is left behind";
}

TEST(NewFile, ThatFindsNoRoomLeavesTheOldOne) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a", "old");
  std::string told;
  {
    const SmallFiles small(1000);
    told = messageOf<std::runtime_error>([&] { writeFile(folder / "a", std::string(2000, 'x')); });
  }
  EXPECT_EQ(told, (folder / "a").string() + ": can't be written: File too large");
  EXPECT_EQ(readBytes(folder / "a"), "old");
  EXPECT_EQ(folder.files(), 1u);
}

namespace fs = std::filesystem;

TEST(NewFile, FollowsLinksAndLeavesThemAlone) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "far");
  test::writeBytes(folder / "far" / "a", "old");
  fs::create_symlink("far/a", folder / "one");
  fs::create_symlink("one", folder / "two");
  writeFile(folder / "two", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "one") && fs::is_symlink(folder / "two"));
  EXPECT_EQ(readBytes(folder / "far" / "a"), "new");
  fs::create_symlink("far/b", folder / "dangling");
  writeFile(folder / "dangling", "made");
  EXPECT_TRUE(fs::is_symlink(folder / "dangling"));
  EXPECT_EQ(readBytes(folder / "far" / "b"), "made");
  fs::create_symlink("circle", folder / "circle");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writeFile(folder / "circle", "x"); }),
            (folder / "circle").string() + ": can't be written: Too many levels of symbolic links");
}

TEST(NewFile, WritesToWhatIsNoFileInPlaceOfReplacingIt) {
  writeFile("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writeFile("/dev/full", "x"); }),
            "/dev/full: can't be written: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  const int reader = ::open((folder / "fifo").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  writeFile(folder / "fifo", "through");
  char bytes[16];
  EXPECT_EQ(::read(reader, bytes, sizeof bytes), 7);
  ::close(reader);
  EXPECT_TRUE(fs::is_fifo(folder / "fifo"));
}

// "ortung ... --out /dev/stdout > file": what else is printed has to get there, too.
TEST(NewFile, OfThisProcessItselfGoesThroughTheDescriptor) {
  const TemporaryFolder folder;
  const int out = ::open((folder / "a").c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  ASSERT_EQ(::write(out, "1", 1), 1);
  writeFile("/dev/fd/" + std::to_string(out), "2");
  writeFile("/proc/self/fd/" + std::to_string(out), "3");
  ASSERT_EQ(::write(out, "4", 1), 1);
  ::close(out);
  EXPECT_EQ(readBytes(folder / "a"), "1234");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writeFile("/dev/fd/999", "x"); }),
            "/dev/fd/999: can't be written: Bad file descriptor");
}

TEST(NewFile, IsForThoseThatTheOldOneWasFor) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a", "old");
  fs::permissions(folder / "a", fs::perms::owner_read | fs::perms::owner_write);
  writeFile(folder / "a", "new");
  EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0600));
}

TEST(NewFile, GrowsInItsPlaceOnceItIsPublished) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a", "old");
  {
    NewFile file(folder / "a");
    file.write("one ");
    EXPECT_EQ(readBytes(folder / "a"), "old");
    file.publish();
    EXPECT_EQ(readBytes(folder / "a"), "one ");
    file.write("two ");
    EXPECT_EQ(readBytes(folder / "a"), "one ");
    file.flush();
    EXPECT_EQ(readBytes(folder / "a"), "one two ");
    EXPECT_EQ(file.size(), 8u);
  }
  EXPECT_EQ(readBytes(folder / "a"), "one two ") << "without commit(), too";
  EXPECT_EQ(folder.files(), 1u);
}

TEST(NewFile, ThatFindsNoRoomToGrowIsWhatItWasAtTheLastFlush) {
  const TemporaryFolder folder;
  NewFile file(folder / "a");
  file.write(std::string(900, 'x'));
  file.publish();
  {
    const SmallFiles small(1000);
    file.write(std::string(200, 'y'));
    EXPECT_EQ(messageOf<std::runtime_error>([&] { file.flush(); }),
              (folder / "a").string() + ": can't be written: File too large");
  }
  EXPECT_EQ(readBytes(folder / "a"), std::string(900, 'x'));
}

/// Writes a file in a process that dies as by kill -9 before it is done.
template <class Action>
void inOneThatDies(const std::filesystem::path& name, const Action& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    NewFile file(name);
    action(file);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
}

TEST(NewFile, OfAProcessThatIsKilledLeavesTheOldOneOrWhatWasPublished) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a", "old");
  inOneThatDies(folder / "a", [](NewFile& file) {
    file.write(std::string(1 << 20, 'x'));
    file.flush();
  });
  EXPECT_EQ(readBytes(folder / "a"), "old");
  EXPECT_EQ(folder.files(), 1u);
  inOneThatDies(folder / "a", [](NewFile& file) {
    file.write("new");
    file.publish();
    file.write("more");
  });
  EXPECT_EQ(readBytes(folder / "a"), "new");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(NewFile, ClearsAwayWhatADeadOneLeftWhereFilesNeedNames) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a", "old");
  test::writeBytes(folder / ".ortung-part-1-1", "dead");
  test::writeBytes(folder / ".ortung-part-1-2", "alive");
  test::writeBytes(folder / "ortung-part-1-3", "another's");
  const int alive = ::open((folder / ".ortung-part-1-2").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(alive, LOCK_EX), 0);
  writeFile(folder / "a", "new");
  EXPECT_EQ(readBytes(folder / "a"), "new");
  EXPECT_FALSE(fs::exists(folder / ".ortung-part-1-1"));
  EXPECT_TRUE(fs::exists(folder / ".ortung-part-1-2"));
  EXPECT_TRUE(fs::exists(folder / "ortung-part-1-3"));
  ::close(alive);
}

}  // namespace
}  // namespace ortung

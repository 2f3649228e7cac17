#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "Files.hpp"
#include "ortung/base/NewFile.hpp"

namespace ortung {
namespace {

using test::messageOf;
using test::readBytes;
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

/// Files of this process may have no more than so many bytes, as on a full disk.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    signal_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~SmallFiles() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  rlimit before_{};
  void (*signal_)(int) = nullptr;
};

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

}  // namespace
}  // namespace ortung

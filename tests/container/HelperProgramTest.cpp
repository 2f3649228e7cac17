#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "Files.hpp"
#include "ortung/base/HelperProgram.hpp"

namespace ortung {
namespace {

using test::TemporaryFolder;

template <class Action>
std::string errorOf(const Action& action) {
  return test::messageOf<std::runtime_error>(action);
}

/// What running a shell script says, with room for 100 bytes.
std::string errorOfScript(const std::string& script) {
  return errorOf([&] { runHelper("/bin/sh", {"-c", script}, "log", 100); });
}

TEST(RunHelper, ReturnsWhatTheProgramPrints) {
  EXPECT_EQ(runHelper("/bin/echo", {"a", "b c"}, "x", 100), "a b c\n");
}

TEST(RunHelper, NamesSignalStatusAndLimit) {
  EXPECT_EQ(
      errorOfScript("kill -SEGV $$"),
      "log: sh was ended by signal 11 (Segmentation fault); the file is damaged or too large");
  EXPECT_EQ(errorOfScript("echo '# error torn'; exit 3"), "log: sh ended with status 3: torn");
  EXPECT_EQ(errorOfScript("while :; do echo aaaaaaaaa; done"),
            "log: sh wrote more than 100 bytes, expected no more");
  EXPECT_EQ(errorOf([] { runHelper("/nowhere/x", {}, "log", 100); }),
            "log: /nowhere/x does not start: No such file or directory");
}

TEST(RunHelper, KeepsOurOpenFilesToItself) {
  const int file = ::open("/dev/null", O_RDONLY);  // not closed by itself in another program
  ASSERT_GT(file, 2);
  const std::string look =
      "test -e /dev/fd/" + std::to_string(file) + " && echo open || echo closed";
  EXPECT_EQ(runHelper("/bin/sh", {"-c", look}, "x", 100), "closed\n");
  ::close(file);
}

TEST(RunHelper, GivesItNothingToReadAndDropsWhatItComplainsAbout) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  ASSERT_EQ(::write(ends[1], "ours", 4), 4);
  ::close(ends[1]);
  const int own = ::dup(STDIN_FILENO);
  ::dup2(ends[0], STDIN_FILENO);
  const std::string read = runHelper("/bin/cat", {}, "x", 100);
  const std::string names =
      runHelper("/bin/sh", {"-c", "readlink /dev/fd/0; readlink /dev/fd/2"}, "x", 100);
  ::dup2(own, STDIN_FILENO);
  ::close(own);
  ::close(ends[0]);
  EXPECT_EQ(read, "");
  EXPECT_EQ(names, "/dev/null\n/dev/null\n");
}

class FindHelper : public ::testing::Test {
 protected:
  FindHelper() { ::setenv("ORTUNG_LIBEXEC", folder_.path().c_str(), 1); }
  ~FindHelper() override { ::unsetenv("ORTUNG_LIBEXEC"); }
  TemporaryFolder folder_;
};

TEST_F(FindHelper, LooksWhereTheEnvironmentSays) {
  test::writeBytes(folder_ / "helper", "#!/bin/sh\n");
  std::filesystem::permissions(folder_ / "helper", std::filesystem::perms::owner_all);
  EXPECT_EQ(findHelper("helper", "log"), folder_ / "helper");
  ::unsetenv("ORTUNG_LIBEXEC");
  const auto own = std::filesystem::read_symlink("/proc/self/exe");
  EXPECT_EQ(findHelper(own.filename(), "log"), own) << "else beside the running program";
}

TEST_F(FindHelper, SaysWhatIsMissingAndWhereItLooked) {
  EXPECT_EQ(errorOf([] { findHelper("helper", "log"); }),
            "log: the program helper is needed, which is not in " + folder_.path().string() +
                "; build with ORTUNG_MRPT=ON or name its folder in ORTUNG_LIBEXEC");
}

}  // namespace
}  // namespace ortung

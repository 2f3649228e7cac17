#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <functional>

#include "Workspace.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

/// Every option of every command that names a file to write.
class EveryOutput : public Workspace {
 protected:
  EveryOutput() {
    learnTables();
    recordRun();
    EXPECT_EQ(ortung({"benchmark", "goalkeeper", "--keepers", "still", "--strikers", "roll",
                      "--episodes", "2", "--json", path("goals.json")})
                  .exitCode,
              0);
  }

  struct Output {
    std::string option;
    std::string input;  ///< a file that the command reads
    std::vector<std::string> command;

    /// As errors call it.
    std::string name() const {
      return "ortung " + command[0] + (command[0] == "benchmark" ? " " + command[1] : "");
    }
  };

  std::vector<Output> outputs() const {
    const std::string robot = path("robot.toml");
    const std::string record = path("run.rec");
    const auto localizing = [&](const std::string& command) {
      return std::vector<std::string>{command, "--source", "record:" + record,  "--robot",
                                      robot,   "--tables", path("hall.ortung"), "--start",
                                      "truth"};
    };
    const std::vector<std::string> import = {
        "import", "sim", path("hall.toml"), "--option", "duration=0.3", "--with-robot", robot};
    const auto with = [](std::vector<std::string> command, const std::vector<std::string>& more) {
      command.insert(command.end(), more.begin(), more.end());
      return command;
    };
    const std::vector<std::string> sim = {"sim", path("hall.toml"), "--robot", robot, "--duration",
                                          "0.3", "--free-run"};
    return {
        {"--out",
         "hall.toml",
         {"learn", "--world", path("hall.toml"), "--robot", robot, "--heading-step", "30", "--cell",
          "0.5"}},
        {"--out", "run.rec", {"learn-motion", record, "--robot", robot}},
        {"--out",
         "run.rec",
         {"train-motion", record, "--robot", robot, "--iterations", "1", "--hidden", "2",
          "--commands-from", "velocities"}},
        {"--json", "run.rec", localizing("eval")},
        {"--report", "hall.ortung", localizing("eval")},
        {"--record", "robot.toml", localizing("eval")},
        {"--out", "run.rec", localizing("localize")},
        {"--out", "robot.toml", import},
        {"--robot-file", "robot.toml", with(import, {"--out", "/dev/null"})},
        {"--out",
         "hall.ortung",
         {"show", path("hall.ortung"), "--robot", robot, "--feature", "LMS200/LRF/*"}},
        {"--record", "hall.toml", sim},
        {"--trace", "robot.toml", sim},
        {"--json", "goals.json", {"benchmark", "merge", path("goals.json")}},
        {"--html", "goals.json", {"benchmark", "merge", path("goals.json")}},
    };
  }

  /// Runs the command with that output.
  Outcome run(const Output& output, const std::string& file, bool force = false) const {
    std::vector<std::string> command = output.command;
    command.push_back(output.option);
    command.push_back(file);
    if (force) command.push_back("--force");
    return ortung(command);
  }
};

TEST_F(EveryOutput, IsRefusedWhereItWouldReplaceAnInputOrAFileOfAnotherKind) {
  for (const Output& output : outputs()) {
    SCOPED_TRACE(output.command[0] + " " + output.option);
    const std::string input = read(output.input);
    fs::remove(path("hard"));
    fs::remove(path("soft"));
    fs::create_hard_link(path(output.input), path("hard"));
    fs::create_symlink(path(output.input), path("soft"));
    for (const std::string name : {"hard", "soft"})
      expectRefused(run(output, path(name), true), 2,
                    output.name() + ": " + path(name) + ": is read by this run", {output.option});
    EXPECT_EQ(read(output.input), input);
    write("mine", "my own work");
    expectRefused(run(output, path("mine")), 1,
                  output.name() + ": " + path("mine") + ": exists and", {"--force"});
    EXPECT_EQ(read("mine"), "my own work");
    expectRefused(run(output, path("none/x")), 1, output.name() + ": ",
                  {path("none/x"), "there is no folder"});
  }
}

/// Reads what a program writes to a FIFO, in its background.
std::string through(const std::string& fifo, const std::function<void()>& action) {
  const int reader = ::open(fifo.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ::fcntl(reader, F_SETPIPE_SZ, 1 << 20);
  action();
  std::string bytes(1u << 20, '\0');
  const ssize_t count = ::read(reader, bytes.data(), bytes.size());
  ::close(reader);
  bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return bytes;
}

// Links stay, and what they name is replaced, if it is of the kind; FIFOs are written to.
TEST_F(EveryOutput, FollowsLinksWritesToWhatIsNoFileAndReplacesItsOwnKind) {
  for (const Output& output : outputs()) {
    SCOPED_TRACE(output.command[0] + " " + output.option);
    fs::remove_all(path("far"));
    fs::create_directory(path("far"));
    fs::remove(path("link"));
    fs::create_symlink("far/file", path("link"));
    fs::remove(path("fifo"));
    ASSERT_EQ(::mkfifo(path("fifo").c_str(), 0600), 0);
    const Outcome made = run(output, path("link"));
    ASSERT_EQ(made.exitCode, 0) << made.err;
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(std::distance(fs::directory_iterator(path("far")), {}), 1);
    const std::string content = read("far/file");
    EXPECT_FALSE(content.empty());
    const std::string piped =
        through(path("fifo"), [&] { EXPECT_EQ(run(output, path("fifo")).exitCode, 0); });
    EXPECT_TRUE(fs::is_fifo(path("fifo")));
    if (isRecord(content)) {
      EXPECT_TRUE(piped.starts_with(kRecordMagic)) << "who reads a pipe gets lines";
    } else {
      EXPECT_EQ(piped.substr(0, 5), content.substr(0, 5));
    }
    EXPECT_FALSE(piped.empty());
    const Outcome again = run(output, path("link"), output.option == "--robot-file");
    EXPECT_EQ(again.exitCode, 0) << again.err;
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(read("far/file").substr(0, 5), content.substr(0, 5));
  }
}

}  // namespace
}  // namespace ortung::test

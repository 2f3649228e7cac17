#include <algorithm>
#include <csignal>
#include <thread>

#include "Await.hpp"
#include "Workspace.hpp"
#include "ortung/records/RecordEnd.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

/// Runs that only a signal ends.
class Live : public Workspace {
 protected:
  std::vector<std::string> simulation() const {
    return {"sim",      path("hall.toml"), "--robot", path("robot.toml"),
            "--record", path("run.rec"),   "--trace", path("trace.csv")};
  }
  /// Waits until a file has so many bytes; it is written by a program that has to be running.
  void waitForBytes(const std::string& name, std::uintmax_t bytes) const {
    std::error_code none;
    EXPECT_TRUE(comesTrue(name + " has " + std::to_string(bytes) + " bytes", [&] {
      const std::uintmax_t size = fs::file_size(path(name), none);
      return !none && size >= bytes;
    }));
  }
  std::size_t readingsOf(const std::string& name) const {
    RecordSource source(path(name));
    std::size_t count = 0;
    for (Message message; source.next(message);) ++count;
    return count;
  }
  /// How often @p c is in the last line, which has to be whole.
  std::ptrdiff_t inLastLine(const std::string& name, char c) const {
    const std::string text = read(name);
    EXPECT_TRUE(text.ends_with('\n')) << name;
    const std::size_t begin = text.rfind('\n', text.size() - 2) + 1;
    return std::count(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), c);
  }
};

TEST_F(Live, SimulationThatASignalEndsLeavesWholeFilesAndSaysWhatItDid) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Program program(simulation());
    waitForBytes("run.rec", 2000);
    program.signal(signal);
    const Outcome outcome = program.finish();
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("readings of scout"), std::string::npos) << outcome.out;
    EXPECT_FALSE(tornEnd(path("run.rec")).has_value());
    EXPECT_GT(readingsOf("run.rec"), 3u);
    EXPECT_EQ(inLastLine("trace.csv", ','), 9);
    EXPECT_EQ(files(),
              (std::vector<std::string>{"hall.toml", "robot.toml", "run.rec", "trace.csv"}));
    fs::remove(path("run.rec"));
  }
}

// Whoever starts it with nohup wants it to outlive the terminal.
TEST_F(Live, SimulationThatIsToIgnoreTheTerminalsEndGoesOn) {
  std::signal(SIGHUP, SIG_IGN);  // inherited
  Program program(simulation());
  std::signal(SIGHUP, SIG_DFL);
  waitForBytes("run.rec", 1000);
  program.signal(SIGHUP);
  waitForBytes("run.rec", 3000);
  program.signal(SIGINT);
  EXPECT_EQ(program.finish().exitCode, 0);
}

TEST_F(Live, SimulationThatIsKilledLeavesARecordUnderItsNameThatCheckTakes) {
  for (const std::uintmax_t bytes : {1, 1500, 4000}) {
    {
      Program program(simulation());
      waitForBytes("run.rec", bytes);
      program.signal(SIGKILL);
      EXPECT_EQ(program.finish().exitCode, 128 + SIGKILL);
    }
    EXPECT_EQ(ortung({"check", path("run.rec")}).exitCode, 0);
    EXPECT_GE(readingsOf("run.rec"), 1u);
    EXPECT_EQ(files(),
              (std::vector<std::string>{"hall.toml", "robot.toml", "run.rec", "trace.csv"}));
    fs::remove(path("run.rec"));
  }
}

/// A server with the world of the hall.
class Served : public Live {
 protected:
  Served() : server_({"sim", path("hall.toml"), "--listen", "127.0.0.1:0"}) {
    const std::string said = server_.waitForOutput("\n");
    port_ = said.substr(said.find("port ") + 5);
    port_.pop_back();
  }
  std::string source() const { return "tcp:127.0.0.1:" + port_; }
  Program server_;
  std::string port_;
};

TEST_F(Served, LocalizationThatASignalEndsLeavesItsPoses) {
  learnTables();
  for (const int signal : {SIGINT, SIGHUP}) {
    Program program({"localize", "--source", source(), "--robot", path("robot.toml"), "--tables",
                     path("hall.ortung"), "--out", path("poses.txt")});
    waitForBytes("poses.txt", 400);
    program.signal(signal);
    const Outcome outcome = program.finish();
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(inLastLine("poses.txt", ' '), 11);
    fs::remove(path("poses.txt"));
  }
}

// A robot that is switched off: the next run knows where it was.
TEST_F(Served, LocalizationThatASignalEndsLeavesItsBelief) {
  learnTables();
  const std::vector<std::string> localize = {"localize",
                                             "--source",
                                             source(),
                                             "--robot",
                                             path("robot.toml"),
                                             "--tables",
                                             path("hall.ortung"),
                                             "--out",
                                             path("poses.txt"),
                                             "--belief",
                                             path("belief"),
                                             "--rate",
                                             "50"};
  std::string before;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Program program(localize);
    waitForBytes("poses.txt", 400);
    program.signal(signal);
    const Outcome outcome = program.finish();
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
    EXPECT_EQ(inLastLine("poses.txt", ' '), 13);
    const std::string belief = read("belief");
    EXPECT_FALSE(belief == before) << "it is that of this run's end";
    before = belief;
    fs::remove(path("poses.txt"));
  }
}

// Whoever pulls the plug loses 10 s at most: the first belief is there with the first poses.
TEST_F(Served, LocalizationThatIsKilledLeavesABelief) {
  learnTables();
  const std::vector<std::string> localize = {
      "localize",          "--source", source(),       "--robot", path("robot.toml"), "--tables",
      path("hall.ortung"), "--belief", path("belief"), "--out",   path("poses.txt")};
  {
    Program program(localize);
    waitForBytes("belief", 1);
    program.signal(SIGKILL);
    EXPECT_EQ(program.finish().exitCode, 128 + SIGKILL);
  }
  fs::remove(path("poses.txt"));
  Program program(localize);
  waitForBytes("poses.txt", 400);
  program.signal(SIGINT);
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
}

TEST_F(Served, EvaluationThatASignalEndsGivesTheFiguresUntilThen) {
  learnTables();
  Program program({"eval", "--source", source(), "--robot", path("robot.toml"), "--tables",
                   path("hall.ortung"), "--record", path("run.rec"), "--json", path("run.json")});
  waitForBytes("run.rec", 4000);
  program.signal(SIGTERM);
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Position error"), std::string::npos);
  EXPECT_NE(read("run.json").find("\"steps\""), std::string::npos);
  EXPECT_FALSE(tornEnd(path("run.rec")).has_value());
  EXPECT_EQ(ortung({"eval", "--source", "record:" + path("run.rec"), "--robot", path("robot.toml"),
                    "--tables", path("hall.ortung")})
                .exitCode,
            0);
}

TEST_F(Served, RecordOfALostServerHasWhatCameUntilThen) {
  Program program({"import", "tcp", "127.0.0.1:" + port_, "--out", path("run.rec"), "--with-robot",
                   path("robot.toml")});
  waitForBytes("run.rec", 2000);
  server_.signal(SIGKILL);
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.err.find("earlier readings are in " + path("run.rec")), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(tornEnd(path("run.rec")).has_value());
  EXPECT_GT(readingsOf("run.rec"), 3u);
}

using Torn = Live;

TEST_F(Torn, RecordIsTakenByCheckWithAWarningAndMendedOnDemand) {
  recordRun();
  const std::string whole = read("run.rec");
  write("run.rec", whole.substr(0, whole.size() - 5));
  const Outcome warned = ortung({"check", path("run.rec")});
  EXPECT_EQ(warned.exitCode, 0);
  EXPECT_NE(warned.err.find("ortung check: warning: " + path("run.rec") + " is torn: its last"),
            std::string::npos)
      << warned.err;
  EXPECT_NE(warned.err.find("--mend"), std::string::npos);
  const auto torn = tornEnd(path("run.rec"));
  ASSERT_TRUE(torn.has_value());
  const Outcome mended = ortung({"check", "--mend", path("run.rec")});
  EXPECT_EQ(mended.exitCode, 0);
  EXPECT_NE(mended.err.find("cut off its last " + std::to_string(torn->bytes) + " bytes"),
            std::string::npos)
      << mended.err;
  EXPECT_EQ(read("run.rec"), whole.substr(0, torn->begin));
  EXPECT_EQ(ortung({"check", "--mend", path("run.rec")}).err, "");
  EXPECT_EQ(read("run.rec"), whole.substr(0, torn->begin));
}

TEST_F(Torn, RecordThatIsStillBeingWrittenIsNotMended) {
  Program program(simulation());
  waitForBytes("run.rec", 1000);
  program.signal(SIGSTOP);
  const std::uintmax_t before = fs::file_size(path("run.rec"));
  fs::resize_file(path("run.rec"), before - 3);
  expectRefused(ortung({"check", "--mend", path("run.rec")}), 1,
                "ortung check: " + path("run.rec") + ": can't be mended", {"still being recorded"});
  EXPECT_EQ(fs::file_size(path("run.rec")), before - 3);
}

/// Standard output that takes nothing.
class FullOutput : public Workspace {};

TEST_F(FullOutput, IsAnErrorOfEveryCommand) {
  learnTables();
  recordRun();
  const std::vector<std::vector<std::string>> commands = {
      {"--help"},
      {"learn", "--help"},
      {"plugins"},
      {"check", path("run.rec")},
      {"localize", "--source", "record:" + path("run.rec"), "--robot", path("robot.toml"),
       "--tables", path("hall.ortung")},
      {"eval", "--source", "record:" + path("run.rec"), "--robot", path("robot.toml"), "--tables",
       path("hall.ortung"), "--start", "truth"},
      {"show", path("hall.ortung"), "--robot", path("robot.toml"), "--feature", "LMS200/LRF/*",
       "--out", path("a.png")},
      {"sim", path("hall.toml"), "--duration", "0.1", "--free-run"},
      {"sim", path("hall.toml"), "--listen", "0"},
      {"import", "sim", path("hall.toml"), "--with-robot", path("robot.toml"), "--option",
       "duration=1", "--out", "/dev/stdout"},
  };
  for (const auto& command : commands) {
    for (const auto& [output, why] : {std::pair("/dev/full", "No space left on device"),
                                      std::pair("closed", "Bad file descriptor")}) {
      const Outcome outcome = ortung(command, {}, output);
      EXPECT_EQ(outcome.exitCode, 1) << command[0] << " " << outcome.err;
      EXPECT_NE(outcome.err.find(std::string("can't be written: ") + why), std::string::npos)
          << command[0] << " " << outcome.err;
    }
  }
  EXPECT_FALSE(fs::is_regular_file("/dev/full"));
}

// As of a program that SIGPIPE ends: `ortung ... | head -1`.
TEST_F(FullOutput, WhoseReaderHasLeftEndsACommandQuietly) {
  learnTables();
  recordRun();
  const std::vector<std::string> mcl = {"--source", "record:" + path("run.rec"),
                                        "--robot",  path("robot.toml"),
                                        "--tables", path("hall.ortung")};
  std::vector<std::vector<std::string>> commands = {
      {"--help"},
      {"learn", "--help"},
      {"plugins"},
      {"check", path("run.rec")},
      {"localize"},
      {"eval", "--start", "truth", "--json", path("eval.json")},
      {"sim", path("hall.toml"), "--duration", "0.1", "--free-run"},
      {"import", "sim", path("hall.toml"), "--with-robot", path("robot.toml"), "--option",
       "duration=1", "--out", "/dev/stdout"},
  };
  for (auto& command : commands) {
    if (command[0] == "localize" || command[0] == "eval")
      command.insert(command.end(), mcl.begin(), mcl.end());
    const Outcome outcome = ortung(command, {}, "left");
    EXPECT_EQ(outcome.exitCode, 141) << command[0] << " " << outcome.err;
    EXPECT_EQ(outcome.err.find("can't"), std::string::npos) << command[0] << " " << outcome.err;
    EXPECT_EQ(outcome.err.find("pipe"), std::string::npos) << command[0] << " " << outcome.err;
  }
}

// Files that are opened while stdout is closed must not get its number, and what is printed.
TEST_F(FullOutput, ThatIsClosedDoesNotEndUpInAnotherFile) {
  learnTables();
  recordRun();
  const Outcome outcome =
      ortung({"eval", "--source", "record:" + path("run.rec"), "--robot", path("robot.toml"),
              "--tables", path("hall.ortung"), "--record", path("copy.txt")},
             {}, "closed");
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_EQ(read("copy.txt"), read("run.rec"));
}

// "--out /dev/stdout > file": both what is written and what is printed is there.
TEST_F(FullOutput, ThatIsAFileIsWrittenToNotReplaced) {
  write("out", "");
  const Outcome outcome =
      ortung({"import", "sim", path("hall.toml"), "--with-robot", path("robot.toml"), "--option",
              "duration=1", "--out", "/dev/stdout"},
             {}, path("out"));
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::string text = read("out");
  EXPECT_TRUE(text.starts_with(kRecordMagic)) << text.substr(0, 100);
  EXPECT_NE(text.find("/dev/stdout: "), std::string::npos);
}

}  // namespace
}  // namespace ortung::test

#include <cerrno>

#include "Workspace.hpp"
#include "ortung/records/RecordEnd.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

/// Each system call of writing a file fails, once; see fault.cpp.
class Fault : public Workspace {
 protected:
  Fault() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skips_ = true;
#endif
    fs::create_directory(path("out"));
  }
  void SetUp() override {
    if (skips_) GTEST_SKIP() << "a sanitizer has to be loaded first itself";
  }

  struct Call {
    const char* name;
    int error;
  };
  static constexpr Call kCalls[] = {{"open", EMFILE}, {"write", ENOSPC},  {"fsync", EIO},
                                    {"linkat", EIO},  {"rename", EACCES}, {"close", EIO}};

  /// Runs @p command with the n-th such call failing; false if it has not that many.
  bool fails(const Call& call, int n, const std::vector<std::string>& command) {
    fs::remove(path("mark"));
    outcome_ = ortung(command,
                      {"LD_PRELOAD=" ORTUNG_FAULT_LIBRARY,
                       "ORTUNG_FAULT=" + std::string(call.name) + " " + std::to_string(n) + " " +
                           std::to_string(call.error),
                       "ORTUNG_FAULT_FOLDER=" + path("out"), "ORTUNG_FAULT_MARK=" + path("mark")});
    return fs::exists(path("mark"));
  }

  /// Tries every call, with and without an older file, and looks at what is there then.
  template <class Look>
  int tryAll(const std::string& name, const std::string& old,
             const std::vector<std::string>& command, const Look& look) {
    int failed = 0;
    for (const Call& call : kCalls) {
      for (const bool isNew : {true, false}) {
        for (int n = 1; n < 20; ++n) {
          SCOPED_TRACE(std::string(call.name) + " " + std::to_string(n) +
                       (isNew ? " new" : " old"));
          fs::remove(path("out/" + name));
          if (!isNew) write("out/" + name, old);
          if (!fails(call, n, command)) {
            EXPECT_EQ(outcome_.exitCode, 0) << outcome_.err;
            break;
          }
          ++failed;
          EXPECT_EQ(outcome_.exitCode, 1);
          EXPECT_NE(outcome_.err.find("out/" + name + ": can't be written: " +
                                      std::generic_category().message(call.error)),
                    std::string::npos)
              << outcome_.err;
          const bool isThere = fs::exists(path("out/" + name));
          look(isThere ? read("out/" + name) : "", isNew ? "" : old);
          EXPECT_EQ(std::distance(fs::directory_iterator(path("out")), {}), isThere ? 1 : 0)
              << "nothing else is left behind";
        }
      }
    }
    return failed;
  }

  bool skips_ = false;
  Outcome outcome_;
};

TEST_F(Fault, OfATableLeavesTheOldOneOrTheWholeNewOne) {
  const std::string old = "PK\x03\x04 open.npy";
  const std::vector<std::string> command = {
      "learn",  "--world", path("hall.toml"), "--robot", path("robot.toml"), "--out", path("out/t"),
      "--cell", "0.5",     "--heading-step",  "10"};
  ASSERT_EQ(ortung(command).exitCode, 0);
  const std::string whole = read("out/t");
  const int failed =
      tryAll("t", old, command, [&](const std::string& now, const std::string& before) {
        EXPECT_TRUE(now == before || now == whole) << now.size();
      });
  EXPECT_GE(failed, 11);  // six calls, the renaming of an old one, and more than one write
}

TEST_F(Fault, OfAJsonLeavesTheOldOneOrTheWholeNewOne) {
  learnTables();
  recordRun();
  const std::string old = "{\"compared_steps\": 0}";
  const std::vector<std::string> command = {"eval",
                                            "--source",
                                            "record:" + path("run.rec"),
                                            "--robot",
                                            path("robot.toml"),
                                            "--tables",
                                            path("hall.ortung"),
                                            "--start",
                                            "truth",
                                            "--json",
                                            path("out/j")};
  const int failed =
      tryAll("j", old, command, [&](const std::string& now, const std::string& before) {
        const bool isWhole = now.starts_with("{\n  \"source\"") && now.ends_with("}\n");
        EXPECT_TRUE(now == before || isWhole) << now;
      });
  EXPECT_GE(failed, 11);
}

// It grows in its place, so what came before the fault is there, and whole.
TEST_F(Fault, OfALiveRecordLeavesTheOldOneOrWholeMoments) {
  const std::string old = std::string(kRecordMagic) + "\n";
  const std::vector<std::string> command = {
      "sim", path("hall.toml"), "--robot",  path("robot.toml"), "--duration",
      "0.5", "--free-run",      "--record", path("out/r")};
  std::size_t most = 0;
  const int failed =
      tryAll("r", old, command, [&](const std::string& now, const std::string& before) {
        if (now == before) return;
        EXPECT_FALSE(tornEnd(path("out/r")).has_value());
        RecordSource source(path("out/r"));
        std::size_t count = 0;
        for (Message message; source.next(message);) ++count;
        EXPECT_GT(count, 0u);
        most = std::max(most, count);
      });
  EXPECT_GE(failed, 13);
  EXPECT_GT(most, 6u);
}

// What can't be read is not taken for the end.
TEST_F(Fault, OfReadingARecordIsTold) {
  recordRun();
  fs::copy(path("run.rec"), path("out/r"));
  const std::vector<std::string> command = {"import", "record", path("out/r"), "--out",
                                            path("again.rec")};
  const std::size_t pieces = read("out/r").size() / 8192;
  ASSERT_GT(pieces, 4u);
  std::size_t failed = 0;
  while (fails({"read", EIO}, static_cast<int>(failed) + 1, command)) {
    ++failed;
    EXPECT_EQ(outcome_.exitCode, 1);
    EXPECT_TRUE(outcome_.err.find("can't be read: Input/output error") != std::string::npos ||
                outcome_.err.find("reading failed") != std::string::npos)
        << outcome_.err;
    EXPECT_NE(outcome_.err.find("out/r:"), std::string::npos) << outcome_.err;
    EXPECT_FALSE(fs::exists(path("again.rec")));
  }
  EXPECT_EQ(outcome_.exitCode, 0) << outcome_.err;
  EXPECT_GT(failed, pieces);
}

}  // namespace
}  // namespace ortung::test

// Work that is cut into shards: what is merged of them has the same bits as what one process makes.
#include <algorithm>
#include <csignal>
#include <map>

#include "Files.hpp"
#include "Paths.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

using Words = std::vector<std::string>;

Words operator+(Words some, const Words& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

class Parts : public Workspace {
 protected:
  /// Runs all shards of a command. @returns the names of the parts, in no order
  Words shards(const Words& command, const std::string& out, int count) const {
    Words parts;
    for (int i = 1; i <= count; ++i) {
      parts.push_back(path(std::to_string(i) + "of" + std::to_string(count) + ".part"));
      const Outcome outcome =
          ortung(command + Words{"--shard", std::to_string(i) + "/" + std::to_string(count), out,
                                 parts.back()});
      EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    std::rotate(parts.begin(), parts.begin() + count / 3, parts.end());
    return parts;
  }
  Outcome merge(const Words& parts, const std::string& out) const {
    return ortung(Words{"merge"} + parts + Words{"--out", path(out), "--force"});
  }
  Words learning() const {
    return {"learn", "--world", path("hall.toml"), "--robot", path("robot.toml")};
  }
  Words evaluating() const {
    return {"eval",
            "--source",
            "record:" + path("run.rec"),
            "--robot",
            path("robot.toml"),
            "--tables",
            path("hall.ortung"),
            "--runs",
            "9",
            "--no-times"};
  }
  /// Contents of the files below a folder, by name.
  std::map<std::string, std::string> contents(const std::string& folder) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / folder))
      if (entry.is_regular_file())
        all[entry.path().lexically_relative(folder_ / folder)] = readBytes(entry.path());
    return all;
  }
};

TEST_F(Parts, OfTablesAreTheTables) {
  ASSERT_EQ(ortung(learning() + Words{"--out", path("one.ortung")}).exitCode, 0);
  for (const int count : {1, 2, 7, 50}) {
    const Outcome merged = merge(shards(learning(), "--out", count), "all.ortung");
    ASSERT_EQ(merged.exitCode, 0) << merged.err;
    EXPECT_EQ(read("all.ortung"), read("one.ortung")) << count << " shards";
  }
}

TEST_F(Parts, OfTablesDoNotDependOnThreads) {
  ASSERT_EQ(ortung(learning() + Words{"--out", path("one.ortung")}).exitCode, 0);
  const Outcome merged =
      merge(shards(learning() + Words{"--threads", "2"}, "--out", 3), "all.ortung");
  ASSERT_EQ(merged.exitCode, 0) << merged.err;
  EXPECT_EQ(read("all.ortung"), read("one.ortung"));
}

// A field of end points sums up what is seen from cells of all shards.
TEST_F(Parts, OfFieldsOfEndPointsAreTheFields) {
  replace("robot.toml", "plugin = \"lrf\"", "plugin = \"lrf\"\nperception = \"endpoints\"");
  ASSERT_EQ(ortung(learning() + Words{"--out", path("one.ortung")}).exitCode, 0);
  const Outcome merged = merge(shards(learning(), "--out", 5), "all.ortung");
  ASSERT_EQ(merged.exitCode, 0) << merged.err;
  EXPECT_EQ(read("all.ortung"), read("one.ortung"));
}

TEST_F(Parts, OfAnEvaluationAreTheEvaluation) {
  learnTables();
  recordRun();
  const Outcome one = ortung(evaluating() + Words{"--json", path("one.json")});
  ASSERT_EQ(one.exitCode, 0) << one.err;
  for (const int count : {1, 2, 7, 50}) {
    const Outcome merged = merge(shards(evaluating(), "--json", count), "all.json");
    ASSERT_EQ(merged.exitCode, 0) << merged.err;
    EXPECT_EQ(read("all.json"), read("one.json")) << count << " shards";
    EXPECT_EQ(merged.out, one.out);
  }
}

TEST_F(Parts, OfOneRunAreThatRun) {
  learnTables();
  recordRun();
  const Words alone = {"eval",
                       "--source",
                       "record:" + path("run.rec"),
                       "--robot",
                       path("robot.toml"),
                       "--tables",
                       path("hall.ortung"),
                       "--no-times"};
  ASSERT_EQ(ortung(alone + Words{"--json", path("one.json")}).exitCode, 0);
  const Outcome merged = merge(shards(alone, "--json", 2), "all.json");
  ASSERT_EQ(merged.exitCode, 0) << merged.err;
  EXPECT_EQ(read("all.json"), read("one.json"));
}

TEST_F(Parts, OfNoiseAreTheNoise) {
  learnTables();
  recordRun();
  const std::string record = "record:" + path("run.rec");
  const Words calibrating = {"calibrate",
                             "noise",
                             record,
                             record + "?to_s=9",
                             "--robot",
                             path("robot.toml"),
                             record + "?from_s=5",
                             "--tables",
                             path("hall.ortung"),
                             "--fixed",
                             "latency"};
  const Outcome one = ortung(calibrating + Words{"--out", path("one.toml")});
  ASSERT_EQ(one.exitCode, 0) << one.err;
  for (const int count : {1, 2, 7, 50}) {
    const Outcome merged = merge(shards(calibrating, "--out", count), "all.toml");
    ASSERT_EQ(merged.exitCode, 0) << merged.err;
    EXPECT_EQ(read("all.toml"), read("one.toml")) << count << " shards";
    EXPECT_EQ(merged.out, one.out);
  }
  const Outcome unnamed = ortung(calibrating + Words{"--shard", "1/2"});
  expectRefused(unnamed, 2, "ortung", {"--shard writes a part, expected its name: --out"});
}

TEST_F(Parts, OfPicturesAreThePictures) {
  const std::string maps = ORTUNG_SOURCE_DIR "/maps";
  const Words drawing = {"export",
                         "images",
                         "sim:" + maps + "/fields/msl.toml?duration=100",
                         "--robot",
                         maps + "/robots/msl_camera.toml",
                         "--count",
                         "5",
                         "--anywhere",
                         "--seed",
                         "1",
                         "--variation",
                         "0.5"};
  const Outcome one = ortung(drawing + Words{"--out", path("one")});
  if (one.err.find("OpenGL") != std::string::npos) GTEST_SKIP() << one.err;
  ASSERT_EQ(one.exitCode, 0) << one.err;
  for (const int count : {1, 3, 7}) {
    const Outcome merged = merge(shards(drawing, "--out", count), "all");
    ASSERT_EQ(merged.exitCode, 0) << merged.err;
    EXPECT_EQ(contents("all"), contents("one")) << count << " shards";
    std::filesystem::remove_all(folder_ / "all");
  }
}

TEST_F(Parts, AreTheSameBytesIfTheyAreMadeAgain) {
  const Words parts = shards(learning(), "--out", 2);
  const std::string first = readBytes(parts.front());
  shards(learning(), "--out", 2);
  EXPECT_EQ(readBytes(parts.front()), first);
}

TEST_F(Parts, MayBeGivenTwice) {
  Words parts = shards(learning(), "--out", 2);
  std::filesystem::copy_file(parts.front(), path("again.part"));
  parts.push_back(path("again.part"));
  EXPECT_EQ(merge(parts, "all.ortung").exitCode, 0);
}

TEST_F(Parts, ThatAreMissingAreNamed) {
  Words parts = shards(learning(), "--out", 5);
  parts.erase(std::find(parts.begin(), parts.end(), path("2of5.part")));
  parts.erase(std::find(parts.begin(), parts.end(), path("4of5.part")));
  expectRefused(merge(parts, "all.ortung"), 3, "ortung merge: missing: 2/5, 4/5", {});
  EXPECT_FALSE(std::filesystem::exists(path("all.ortung")));
}

TEST_F(Parts, ThatAreTornAreNamed) {
  const Words parts = shards(learning(), "--out", 2);
  const std::string whole = readBytes(parts[0]);
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{0}}) {
    writeBytes(parts[0], whole.substr(0, size));
    const Outcome outcome = merge(parts, "all.ortung");
    EXPECT_EQ(outcome.exitCode, 3);
    EXPECT_NE(outcome.err.find(parts[0]), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("missing: "), std::string::npos) << outcome.err;
  }
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  writeBytes(parts[0], flipped);
  EXPECT_EQ(merge(parts, "all.ortung").exitCode, 3);
}

TEST_F(Parts, OfAnotherJobAreNamedWithWhatDiffers) {
  Words parts = shards(learning(), "--out", 3);
  const Outcome other =
      ortung(learning() + Words{"--cell", "0.2", "--shard", "2/3", "--out", path("2of3.part")});
  ASSERT_EQ(other.exitCode, 0) << other.err;
  const Outcome outcome = merge(parts, "all.ortung");
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_NE(
      outcome.err.find(path("2of3.part") + ": is of another job: --cell is [\"0.2\"], that of "
                                           "the others [\"0.1\"]"),
      std::string::npos)
      << outcome.err;
}

TEST_F(Parts, FromAnotherRobotFileAreRefused) {
  Words parts = shards(learning(), "--out", 3);
  replace("robot.toml", "fov_deg = 180", "fov_deg = 170");
  const Outcome other = ortung(learning() + Words{"--shard", "1/3", "--out", path("1of3.part")});
  ASSERT_EQ(other.exitCode, 0) << other.err;
  const Outcome outcome = merge(parts, "all.ortung");
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_NE(outcome.err.find("robot.toml"), std::string::npos) << outcome.err;
}

TEST_F(Parts, OfTablesNeedTheFilesTheyWereMadeFrom) {
  const Words parts = shards(learning(), "--out", 2);
  replace("robot.toml", "fov_deg = 180", "fov_deg = 170");
  expectRefused(merge(parts, "all.ortung"), 3, "ortung merge: " + path("robot.toml"),
                {"has changed since the parts were made from it"});
  std::filesystem::remove(path("robot.toml"));
  expectRefused(merge(parts, "all.ortung"), 3, "ortung merge: " + path("robot.toml"),
                {"can't be read"});
}

TEST_F(Parts, DoNotGoWithPagesAndRecords) {
  learnTables();
  recordRun();
  for (const std::string option : {"--report", "--record"}) {
    const Outcome outcome = ortung({"eval", "--source", "record:" + path("run.rec"), "--robot",
                                    path("robot.toml"), "--tables", path("hall.ortung"), "--shard",
                                    "1/2", "--json", path("a.part"), option, path("x")});
    expectRefused(outcome, 2, "ortung eval: ", {"do not go with --shard"});
  }
  expectRefused(ortung(evaluating() + Words{"--shard", "1/2"}), 2, "ortung eval: --shard writes",
                {"--json"});
}

TEST_F(Parts, DoNotReplaceFilesOfOtherKinds) {
  write("notes.part", "mine");
  expectRefused(ortung(learning() + Words{"--shard", "1/2", "--out", path("notes.part")}), 1,
                "ortung learn: " + path("notes.part"), {"a part for `ortung merge`"});
  EXPECT_EQ(read("notes.part"), "mine");
}

TEST_F(Parts, LeaveNothingBehindWhenTheirProcessIsKilled) {
  const Words command =
      learning() + Words{"--shard", "1/1", "--out", path("a.part"), "--cell", "0.01", "--progress"};
  Program program(command);
  ASSERT_TRUE(program.waitForError("generating readings ["));
  program.signal(SIGKILL);
  program.finish();
  EXPECT_EQ(files(), (Words{"hall.toml", "robot.toml"}));
}

}  // namespace
}  // namespace ortung::test

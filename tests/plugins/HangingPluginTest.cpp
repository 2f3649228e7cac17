#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "Files.hpp"
#include "Paths.hpp"
#include "Program.hpp"
#include "ortung/records/RecordSource.hpp"

/// Plugins that do not come back from a call: the program says which one, saves what it has, and
/// ends.
namespace ortung::test {
namespace {

struct BadRun {
  explicit BadRun(const std::string& robot) {
    writeBytes(folder / "world.toml",
               "[world]\nx_m = [-6, 6]\ny_m = [-4, 4]\n"
               "[[rectangle]]\ncenter_m = [5, 3]\nsize_m = [1, 1]\n");
    writeBytes(folder / "robot.toml", "[robot]\nname = \"bob\"\n" + robot);
  }
  std::string at(const std::string& name) const { return (folder / name).string(); }

  Outcome of(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--plugin-seconds", "0.4"});
    return ortung(arguments, {"ORTUNG_PLUGIN_PATH=" ORTUNG_PLUGINS_DIR ":" TEST_PLUGINS});
  }
  Outcome simulated(const std::string& duration = "1000") const {
    return of({"sim", at("world.toml"), "--robot", at("robot.toml"), "--free-run", "--duration",
               duration, "--record", at("run.rec"), "--trace", at("run.csv")});
  }
  /// Robots with a player each, who notes that it has been ended.
  Outcome played(const std::vector<std::string>& players, const std::string& duration) const {
    std::vector<std::string> arguments = {"sim",    at("world.toml"), "--free-run", "--duration",
                                          duration, "--record",       at("run.rec")};
    for (const std::string& player : players)
      arguments.insert(arguments.end(),
                       {"--player", "misbehaving:robot=" + at("robot.toml") +
                                        "&notes=" + at("notes.txt") + "&" + player});
    return of(arguments);
  }
  std::string notes() const {
    return std::filesystem::exists(at("notes.txt")) ? readBytes(at("notes.txt")) : "";
  }
  TemporaryFolder folder;
};

const std::string kOdometry = "[[sensor]]\nplugin = \"odometry\"\nperiod_s = 0\n";

std::string loopIn(const std::string& where, int after) {
  return "where = \"" + where + "\"\nhow = \"loop\"\nafter = " + std::to_string(after) + "\n";
}

void expectIn(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "no \"" << part << "\" in: " << text;
}

/// All that came before the call is in both files, to the last line.
void expectSaved(const BadRun& run, const std::string& feature, std::size_t readings, int moments) {
  RecordSource record(run.at("run.rec"));
  Message message;
  std::size_t found = 0;
  while (record.next(message)) found += toText(message.id) == feature ? 1 : 0;
  EXPECT_EQ(found, readings);
  const std::string trace = readBytes(run.at("run.csv"));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), '\n'), 1 + moments);  // every 50 ms
  EXPECT_TRUE(trace.ends_with('\n'));
}

TEST(Hanging, ASensorEndsTheRunWithItsNameAndTheRecordIsWhole) {
  const BadRun run(
      "[[sensor]]\nplugin = \"odometry\"\nperiod_s = 0\n[[sensor]]\nplugin = \"misbehaving\"\n" +
      loopIn("generateData", 200));
  const Outcome outcome = run.simulated();
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  expectIn(outcome.err, "the sensor plugin 'misbehaving' of robot bob (bad/misbehaving/pose)");
  expectIn(outcome.err, "has been in generateData for 0.");
  expectIn(outcome.err, "--plugin-seconds");
  expectSaved(run, "bad/misbehaving/pose", 200, 41);
}

TEST(Hanging, ADriveEndsTheRunWithItsName) {
  const BadRun run(
      "[[sensor]]\nplugin = \"odometry\"\nperiod_s = 0\n[drive]\nplugin = \"misbehaving\"\n" +
      loopIn("measure", 100));
  const Outcome outcome = run.simulated();
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  expectIn(outcome.err, "the drive plugin 'misbehaving' of robot bob has been in measure");
  expectSaved(run, "odometry/odometry/pose", 100, 21);
}

TEST(Hanging, APlayerEndsTheRunAndTheOthersAreEnded) {
  const BadRun run(kOdometry);
  const Outcome outcome =
      run.played({"name=ann", "name=bea&where=senseAndAct&how=loop&after=100", "name=cid"}, "1000");
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  expectIn(outcome.err, "the player 'misbehaving' of robot bea has been in senseAndAct for 0.");
  EXPECT_EQ(run.notes(), "ann\ncid\n") << outcome.err;
  RecordSource record(run.at("run.rec"));
  Message message;
  std::size_t found = 0;
  while (record.next(message)) ++found;
  EXPECT_EQ(found, 200U) << "two of each cycle, up to the one before";
}

TEST(Hanging, ASensorEndsTheRunAndAllPlayersAreEnded) {
  const BadRun run(kOdometry + "[[sensor]]\nplugin = \"misbehaving\"\n" +
                   loopIn("generateData", 100));
  const Outcome outcome = run.played({"name=ann", "name=bea"}, "1000");
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  EXPECT_EQ(run.notes(), "ann\nbea\n") << outcome.err;
}

TEST(Hanging, APlayerThatHangsInItsEndHoldsUpNobody) {
  const BadRun run(kOdometry);
  const Outcome outcome =
      run.played({"name=ann&where=senseAndAct&how=loop", "name=bea&where=end&how=loop"}, "1000");
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  expectIn(outcome.err, "not all players have ended within 2 s");
  const Outcome atTheEnd = run.played({"name=bea&where=end&how=loop", "name=cid"}, "0.1");
  EXPECT_EQ(atTheEnd.exitCode, 1) << atTheEnd.err;
  expectIn(atTheEnd.err, "the player 'misbehaving' of robot bea has been in end for 0.");
  EXPECT_EQ(run.notes(), "cid\n");
}

TEST(Hanging, PlayersAreEndedWithTheirRun) {
  const BadRun run(kOdometry);
  const Outcome outcome =
      run.played({"name=ann", "name=bea&where=end&how=throw", "name=cid"}, "0.1");
  EXPECT_EQ(run.notes(), "ann\ncid\n");
  EXPECT_EQ(outcome.exitCode, 1) << "what went wrong at the end is told, too";
  expectIn(outcome.err, "robot bea failed in end: a wheel came off");
}

TEST(Hanging, AnExtractorEndsTheRunWithItsName) {
  const BadRun run(
      "[[sensor]]\nplugin = \"odometry\"\nperiod_s = 0\n[[sensor]]\nplugin = "
      "\"misbehaving_extracted\"\n" +
      loopIn("extract", 50));
  const Outcome outcome = run.simulated();
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  expectIn(outcome.err, "the extractor of 'misbehaving_extracted'");
  expectSaved(run, "bad/extracted/pose", 50, 11);
}

TEST(Hanging, AMotionModelEndsLocalizationAndThePosesUntilThenAreThere) {
  const BadRun run(
      "[[sensor]]\nplugin = \"odometry\"\nperiod_s = 0.05\n[[sensor]]\nplugin = \"lrf\"\nbeams = "
      "30\n"
      "period_s = 0.1\n[motion]\nplugin = \"misbehaving\"\n" +
      loopIn("sampleMotion", 20));
  ASSERT_EQ(run.simulated("5").exitCode, 0);
  ASSERT_EQ(run.of({"learn", "--world", run.at("world.toml"), "--robot", run.at("robot.toml"),
                    "--out", run.at("out.ortung"), "--cell", "0.5"})
                .exitCode,
            0);
  const Outcome outcome =
      run.of({"localize", "--source", "record:" + run.at("run.rec"), "--robot",
              run.at("robot.toml"), "--tables", run.at("out.ortung"), "--start", "truth",
              "--particles", "50", "--threads", "1", "--out", run.at("poses.csv")});
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  expectIn(outcome.err, "has been in sampleMotion");
  const std::string poses = readBytes(run.at("poses.csv"));
  EXPECT_GE(std::count(poses.begin(), poses.end(), '\n'), 1 + 5) << poses;
  EXPECT_TRUE(poses.ends_with('\n'));
}

TEST(Hanging, LearningEndsAndLeavesNoTable) {
  const BadRun run("[[sensor]]\nplugin = \"misbehaving_range\"\n" + loopIn("generateData", 100));
  const Outcome outcome = run.of({"learn", "--world", run.at("world.toml"), "--robot",
                                  run.at("robot.toml"), "--out", run.at("out.ortung")});
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  expectIn(outcome.err, "the sensor plugin 'misbehaving_range'");
  EXPECT_EQ(run.folder.files(), 2u);
}

TEST(Hanging, AConstructorEndsTheProgram) {
  const BadRun run("[[sensor]]\nplugin = \"misbehaving\"\n" + loopIn("construct", 0));
  const Outcome outcome = run.of({"check", run.at("robot.toml")});
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  expectIn(outcome.err, "the plugin 'misbehaving' has been in its constructor");
}

// The second robot's sensor fails first.
TEST(Hanging, ProblemsOfSeveralRobotsAreToldOnceEach) {
  const BadRun run("");
  const auto robot = [&](const std::string& name, int after) {
    writeBytes(run.folder / (name + ".toml"),
               "[robot]\nname = \"" + name +
                   "\"\n[[sensor]]\nplugin = \"misbehaving\"\nwhere = \"generateData\"\nafter = " +
                   std::to_string(after) + "\n");
    return run.at(name + ".toml");
  };
  const Outcome outcome = run.of({"sim", run.at("world.toml"), "--robot", robot("ann", 60),
                                  "--robot", robot("bob", 20), "--free-run", "--duration", "1"});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
  expectIn(outcome.err, "robot ann (bad/misbehaving/pose)");
  expectIn(outcome.err, "robot bob (bad/misbehaving/pose)");
}

TEST(Hanging, BadDrivesOfARunLeaveARecordThatIsWhole) {
  const BadRun run(
      "[[sensor]]\nplugin = \"odometry\"\nperiod_s = 0\n[drive]\nplugin = \"misbehaving\"\nwhere = "
      "\"measure\"\nhow = \"int\"\nafter = 50\n");
  const Outcome outcome =
      run.of({"sim", run.at("world.toml"), "--robot", run.at("robot.toml"), "--free-run",
              "--duration", "1.999", "--record", run.at("run.rec"), "--trace", run.at("run.csv")});
  EXPECT_EQ(outcome.exitCode, 1);
  expectIn(outcome.err, "the drive plugin 'misbehaving' of robot bob failed in measure");
  expectSaved(run, "odometry/odometry/pose", 200, 40);
}

}  // namespace
}  // namespace ortung::test

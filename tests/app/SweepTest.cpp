// Sweeps as a user, a cluster, and bad luck run them.
#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "Files.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class Sweep : public Workspace {
 protected:
  Sweep() {
    learnTables();
    recordRun();
    write("sweep.toml",
          R"(command = ["eval", "--source", "record:run.rec", "--start", "truth", "--robot",
  "robot.toml", "--tables", "hall.ortung", "--set", "mcl.particles={n}", "--seed", "{seed}",
  "--no-times"]
[vary]
n = [100, 200]
seed = "1..5"
)");
  }
  Outcome sweep(const Words& words) const {
    Words all = {"sweep"};
    all.insert(all.end(), words.begin(), words.end());
    return ortung(all);
  }
  Outcome run(const std::string& dir, const Words& more = {}) const {
    Words words = {"run", path("sweep.toml"), "--dir", path(dir)};
    words.insert(words.end(), more.begin(), more.end());
    return sweep(words);
  }
  std::string csv(const std::string& dir) const {
    const Outcome outcome =
        sweep({"table", path(dir), "--by", "n,seed", "--csv", path(dir + ".csv"), "--force"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return read(dir + ".csv");
  }
  Words filesOf(const std::string& dir) const {
    Words names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / dir))
      if (entry.is_regular_file())
        names.push_back(entry.path().lexically_relative(folder_ / dir).string());
    std::sort(names.begin(), names.end());
    return names;
  }
};

TEST_F(Sweep, RunsEachTaskOnceAndTellsOfIt) {
  EXPECT_EQ(sweep({"plan", path("sweep.toml")}).out.find("10 tasks"),
            sweep({"plan", path("sweep.toml")}).out.size() - 9);
  const Outcome first = run("all", {"--jobs", "2"});
  ASSERT_EQ(first.exitCode, 0) << first.err;
  EXPECT_EQ(first.out, "10 of 10 tasks were run, 0 failed\n");
  EXPECT_EQ(run("all").out, "0 of 10 tasks were run, 0 failed\n");
  const Outcome status = sweep({"status", path("all")});
  EXPECT_EQ(status.exitCode, 0);
  EXPECT_EQ(status.out, "10 of 10 tasks are done\n");
  EXPECT_EQ(filesOf("all"),
            (Words{"costs/1-of-1.tsv", "folder.txt", "shards/1-of-1.pack", "sweep.toml"}));
  EXPECT_NE(sweep({"plan", path("sweep.toml"), "--dir", path("all")}).out.find(" s, "),
            std::string::npos);
}

// Of tasks that differ by the seed alone what one has cost is what another will.
TEST_F(Sweep, PlansByWhatWasRun) {
  EXPECT_NE(sweep({"plan", path("sweep.toml")}).err.find("known once some were run"),
            std::string::npos);
  ASSERT_EQ(run("some", {"--task", "n=100,seed=2"}).exitCode, 0);
  EXPECT_EQ(filesOf("some").front().substr(0, 6), "costs/");
  const Outcome plan = sweep({"plan", path("sweep.toml"), "--dir", path("some")});
  EXPECT_EQ(plan.err, "");
  std::istringstream lines(plan.out);
  std::size_t known = 0;
  std::size_t estimated = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" tasks, about ") != line.npos) {
      EXPECT_NE(line.find(" MB at a time, by the 1 that were run"), line.npos) << line;
      continue;
    }
    estimated += line.find("  about ") != line.npos ? 1 : 0;
    known += line.find("n=100,seed=2  0.") != line.npos ? 1 : 0;
  }
  EXPECT_EQ(known, 1u) << plan.out;
  EXPECT_EQ(estimated, 9u) << plan.out;
  ASSERT_EQ(run("some").exitCode, 0);
  EXPECT_EQ(filesOf("some"),
            (Words{"costs/1-of-1.tsv", "folder.txt", "shards/1-of-1.pack", "sweep.toml"}));
}

// The figures are those of the command itself.
TEST_F(Sweep, HasTheFiguresOfItsCommand) {
  ASSERT_EQ(run("all").exitCode, 0);
  const Outcome alone =
      ortung({"eval", "--source", "record:" + path("run.rec"), "--start", "truth", "--robot",
              path("robot.toml"), "--tables", path("hall.ortung"), "--set", "mcl.particles=200",
              "--seed", "3", "--no-times", "--json", path("alone.json")});
  ASSERT_EQ(alone.exitCode, 0) << alone.err;
  const std::string json = read("alone.json");
  const std::size_t at = json.find("\"position_rmse_m\": ") + 19;
  const std::string rmse = json.substr(at, json.find(',', at) - at);
  EXPECT_NE(csv("all").find("200,3,1,1,"), std::string::npos);
  EXPECT_NE(csv("all").find("," + rmse + ","), std::string::npos) << rmse << "\n" << csv("all");
}

TEST_F(Sweep, ShardsAndTasksGiveTheSameTable) {
  ASSERT_EQ(run("all").exitCode, 0);
  const std::string table = csv("all");
  for (const char* shard : {"1/3", "2/3", "3/3"})
    ASSERT_EQ(run("cut", {"--shard", shard}).exitCode, 0);
  EXPECT_EQ(csv("cut"), table);
  for (int n : {100, 200})
    for (int seed = 1; seed <= 5; ++seed)
      ASSERT_EQ(
          run("single", {"--task", "n=" + std::to_string(n) + ",seed=" + std::to_string(seed)})
              .exitCode,
          0);
  EXPECT_EQ(csv("single"), table);
  EXPECT_EQ(read("cut/shards/2-of-3.pack").find("nothing"), std::string::npos);
}

TEST_F(Sweep, ResultsAreStaleOnceAnInputHasChanged) {
  ASSERT_EQ(run("all").exitCode, 0);
  replace("robot.toml", "fov_deg = 180", "fov_deg = 180 ");
  const Outcome status = sweep({"status", path("all")});
  EXPECT_EQ(status.exitCode, 1);
  EXPECT_NE(status.out.find("n=100,seed=1: robot.toml has changed"), std::string::npos)
      << status.out;
  EXPECT_NE(status.out.find("0 of 10 tasks are done, 10 stale"), std::string::npos);
  EXPECT_EQ(run("all").out, "10 of 10 tasks were run, 0 failed\n");
  EXPECT_EQ(sweep({"status", path("all")}).exitCode, 0);
}

TEST_F(Sweep, MoreValuesLeaveWhatIsDone) {
  ASSERT_EQ(run("all").exitCode, 0);
  replace("sweep.toml", "1..5", "1..6");
  EXPECT_EQ(run("all").out, "2 of 12 tasks were run, 0 failed\n");
}

TEST_F(Sweep, TornFilesAreTornAndMadeAnew) {
  ASSERT_EQ(run("all", {"--task", "n=100,seed=1"}).exitCode, 0);
  const std::string part = "all/" + filesOf("all").back();
  ASSERT_NE(part.find(".part"), std::string::npos);
  writeBytes(folder_ / part, read(part).substr(0, 200));
  const Outcome status = sweep({"status", path("all")});
  EXPECT_NE(status.out.find("torn "), std::string::npos) << status.out;
  EXPECT_NE(status.out.find("9 missing, 1 torn"), std::string::npos) << status.out;
  EXPECT_EQ(run("all").out, "10 of 10 tasks were run, 0 failed\n");
  writeBytes(folder_ / "all/shards/1-of-1.pack", "PK");
  EXPECT_EQ(run("all").out, "10 of 10 tasks were run, 0 failed\n");
  EXPECT_EQ(sweep({"status", path("all")}).exitCode, 0);
}

TEST_F(Sweep, TasksThatFailAreNamedWithWhatTheySaid) {
  replace("sweep.toml", "\"robot.toml\"", "\"none.toml\"");
  const Outcome outcome = run("all");
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.err.find("n=100,seed=1: failed, see "), std::string::npos) << outcome.err;
  const std::string said = read("all/" + filesOf("all").front());
  EXPECT_NE(said.find("none.toml"), std::string::npos) << said;
  EXPECT_NE(sweep({"status", path("all")}).out.find("10 failed"), std::string::npos);
  ASSERT_EQ(sweep({"table", path("all"), "--json", path("all.json")}).exitCode, 0);
  const nlohmann::json first = nlohmann::json::parse(read("all.json"))["tasks"][0];
  EXPECT_TRUE(first["figures"].is_null());
  EXPECT_NE(first["failed"].get<std::string>().find("none.toml"), std::string::npos);
}

TEST_F(Sweep, AveragesAndWritesPages) {
  ASSERT_EQ(run("all", {"--shard", "1/2"}).exitCode, 0);
  const Outcome outcome = sweep({"table", path("all"), "--figures", "position_rmse_m,lost_share",
                                 "--html", path("all.html"), "--json", path("all.json")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("| n | done | position_rmse_m | lost_share |"), std::string::npos);
  EXPECT_NE(outcome.out.find("| 100 | 3 of 5 | "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" ± "), std::string::npos);
  EXPECT_NE(outcome.err.find("5 of 10 tasks have no result, e.g. n=100,seed=2"), std::string::npos)
      << outcome.err;
  EXPECT_NE(read("all.html").find("<svg"), std::string::npos);
  const nlohmann::json figures = nlohmann::json::parse(read("all.json"));
  ASSERT_EQ(figures["tasks"].size(), 10u);
  std::size_t done = 0;
  for (const auto& task : figures["tasks"]) {
    EXPECT_EQ(task["task"], "n=" + task["values"]["n"].get<std::string>() +
                                ",seed=" + task["values"]["seed"].get<std::string>());
    if (task["figures"].is_null()) continue;
    ++done;
    EXPECT_GT(task["figures"]["position_rmse_m"].get<double>(), 0.0);
    EXPECT_EQ(task["figures"]["seed"].dump(), task["values"]["seed"].get<std::string>());
  }
  EXPECT_EQ(done, 5u);
  expectRefused(sweep({"table", path("all"), "--by", "x"}), 2, "ortung sweep table: --by is 'x'",
                {});
  expectRefused(sweep({"status", path("none")}), 1, "ortung sweep status: ", {"no folder"});
  expectRefused(run("all", {"--task", "x"}), 2, "ortung sweep run: --task is 'x'", {"no task"});
}

// A slip of the pen must not look like figures that are not known.
TEST_F(Sweep, FiguresThatNoTaskHasAreRefusedWithTheNearest) {
  ASSERT_EQ(run("all", {"--task", "n=100,seed=1"}).exitCode, 0);
  const auto tableOf = [this](const std::string& figure) {
    return sweep({"table", path("all"), "--figures", figure, "--csv", path("no.csv")});
  };
  expectRefused(tableOf("position_medain_m"), 2,
                "ortung sweep table: --figures: no finished task has a figure 'position_medain_m': "
                "did you mean 'position_median_m'?",
                {});
  expectRefused(tableOf("lost_share,nees_mean.p50"), 2,
                "ortung sweep table: --figures: no finished task has a figure 'nees_mean.p50'", {});
  expectRefused(tableOf("at_corrections"), 2,
                "ortung sweep table: --figures: no finished task has a figure 'at_corrections'",
                {"there are at_corrections.position_rmse_m"});
  EXPECT_FALSE(fs::exists(folder_ / "no.csv"));
  // A figure that is there but not known is a dash, as the ratio to a bound that was not wanted.
  EXPECT_EQ(tableOf("ratio_rmse").exitCode, 0);
}

// Of cases the figures are in a summary, which the table has by itself.
TEST_F(Sweep, CasesHaveTheFiguresOfTheirSummary) {
  replace("sweep.toml", "\"--start\", \"truth\"", "\"--wake-ups\", \"2\"");
  ASSERT_EQ(run("all", {"--task", "n=100,seed=1"}).exitCode, 0);
  const Outcome usual = sweep({"table", path("all")});
  EXPECT_EQ(usual.out.substr(0, usual.out.find('\n')),
            "| n | done | summary.0.right.share | summary.0.after_s.p50 | "
            "summary.0.position_m.p50 | summary.0.lost_share |");
  EXPECT_NE(usual.out.find("| 100 | 1 of 5 | "), std::string::npos) << usual.out;
  expectRefused(sweep({"table", path("all"), "--figures", "right.share"}), 2,
                "ortung sweep table: --figures: no finished task has a figure 'right.share': did "
                "you mean 'summary.0.right.share'?",
                {"There are "});
}

// Who ends a sweep learns at once that a task is still running, and which results stay.
TEST_F(Sweep, SaysThatItEndsAfterTheRunningTask) {
  replace("sweep.toml", "1..5", "1..200");
  Program program(
      {"sweep", "run", path("sweep.toml"), "--dir", path("all"), "--progress", "--jobs", "3"});
  ASSERT_TRUE(program.waitForError(" s left"));  // so some have ended, and others run
  program.signal(SIGTERM);
  const Outcome outcome = program.finish();
  EXPECT_NE(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("ends after the running task"), std::string::npos) << outcome.err;
}

// A misspelt setting is in no line of the robot file.
TEST_F(Sweep, SettingsThatAreWrongAreNamedAsGiven) {
  const auto evalWith = [this](const std::string& setting) {
    return ortung({"eval", "--source", "record:" + path("run.rec"), "--robot", path("robot.toml"),
                   "--tables", path("hall.ortung"), "--set", "mcl.min_particles=50", "--set",
                   setting});
  };
  expectRefused(evalWith("mcl.particels=500"), 2,
                "ortung eval: --set mcl.particels=500: particels is not known here (did you mean "
                "'particles'?)",
                {});
  expectRefused(evalWith("mcl.particles=-5"), 2,
                "ortung eval: --set mcl.particles=-5: particles is -5, must be ", {});
}

// Whatever dies on the way: what is done stays done, and nothing else is left. Of fifty shards ten
// are killed, some before their task has begun, some in the middle of it.
TEST_F(Sweep, KilledShardsAreRunAgainAndNothingIsLost) {
  replace("sweep.toml", "1..5", "1..25");
  ASSERT_EQ(run("one", {"--jobs", "2"}).exitCode, 0);
  const std::string table = csv("one");
  std::vector<int> numbers(50);
  std::iota(numbers.begin(), numbers.end(), 1);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937(1));
  const auto shard = [](int i) { return std::to_string(i) + "/50"; };
  for (std::size_t i = 0; i < 10; ++i) {
    Program program({"sweep", "run", path("sweep.toml"), "--dir", path("all"), "--shard",
                     shard(numbers[i]), "--progress"});
    if (i % 2 == 0) program.waitForError("running tasks");
    program.signal(SIGKILL);
    program.finish();
  }
  for (const int i : numbers) ASSERT_EQ(run("all", {"--shard", shard(i)}).exitCode, 0);
  EXPECT_EQ(csv("all"), table);
  for (const std::string& name : filesOf("all"))
    EXPECT_TRUE(name.starts_with("shards/") || name.starts_with("costs/") || name == "sweep.toml" ||
                name == "folder.txt")
        << name;
}

}  // namespace
}  // namespace ortung::test

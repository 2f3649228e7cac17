// What `ortung export` writes, opened by MRPT's own tools.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "Files.hpp"
#include "Workspace.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/records/RecordSource.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

bool isThere(const char* program) {
  return std::system((std::string("command -v ") + program + " > /dev/null 2>&1").c_str()) == 0;
}

class Export : public Workspace {
 protected:
  void exportRun() const {
    recordRun();
    const Outcome outcome =
        ortung({"export", "rawlog", "record:" + path("run.rec"), "--robot", path("robot.toml"),
                "--out", path("run.rawlog"), "--truth", path("truth.txt")});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  }
  std::vector<Message> readingsOf(const std::string& name, const SensorId& feature) const {
    RecordSource source(path(name));
    std::vector<Message> found;
    for (Message message; source.next(message);)
      if (message.id == feature) found.push_back(message);
    return found;
  }
  std::string run(const std::string& command) const {
    const std::string line = "cd " + folder_.string() + " && " + command + " 2>&1 < /dev/null";
    std::FILE* pipe = ::popen(line.c_str(), "r");
    std::string text;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
    ::pclose(pipe);
    return text;
  }
};

const SensorId kScan{"LMS200", "LRF", "180DegreeScan"};
const SensorId kOdometry{"odometry", "odometry", "pose"};

TEST_F(Export, HtmlIsOnePageWithTheRunAndNothingFromElsewhere) {
  recordRun();
  const Outcome outcome = ortung({"export", "html", path("run.rec"), "--out", path("run.html")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::string page = readBytes(path("run.html"));
  const std::string begin = "<script id=\"run\" type=\"application/json\">";
  const std::size_t at = page.find(begin);
  ASSERT_NE(at, page.npos);
  const std::size_t end = page.find("</script>", at);
  const auto told = nlohmann::json::parse(page.substr(at + begin.size(), end - at - begin.size()));
  ASSERT_EQ(told["robots"].size(), 1u);
  EXPECT_EQ(told["robots"][0]["name"], "run");
  EXPECT_GT(told["end_us"], 1'000'000);
  EXPECT_TRUE(told["world"][0].get<std::string>().starts_with("world=run.rec kind=record"));
  EXPECT_NE(page.find("default-src 'none'"), page.npos);
  for (const char* elsewhere : {"src=\"http", "href=\"http", "src=\"./", "href=\"./"})
    EXPECT_EQ(page.find(elsewhere), page.npos) << elsewhere;
  // It replaces no other kind of file unasked.
  EXPECT_NE(ortung({"export", "html", path("run.rec"), "--out", path("run.rec")}).exitCode, 0);
}

TEST_F(Export, RawlogComesBackAsTheSameRangesAndOdometry) {
  exportRun();
  ASSERT_EQ(ortung({"import", "rawlog", path("run.rawlog"), "--out", path("back.rec"),
                    "--robot-file", path("back.toml"), "--option", "gt=" + path("truth.txt")})
                .exitCode,
            0);
  const auto scans = readingsOf("run.rec", kScan);
  const auto back = readingsOf("back.rec", {"laser", "LRF", "scan"});
  ASSERT_EQ(scans.size(), back.size());
  ASSERT_GT(scans.size(), 100u);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(scans[i].stamp, back[i].stamp);
    EXPECT_EQ(scans[i].words, back[i].words);
  }
  const auto odometry = readingsOf("run.rec", kOdometry);
  const auto odometryBack = readingsOf("back.rec", kOdometry);
  ASSERT_EQ(odometry.size(), odometryBack.size());
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    EXPECT_EQ(odometry[i].stamp, odometryBack[i].stamp);
    for (std::size_t k = 0; k < 3; ++k)  // the pose; a rawlog's reader makes velocities of it
      EXPECT_EQ(odometry[i].words[k], odometryBack[i].words[k]);
  }
  // The scanner is where it was, and looks where it did.
  EXPECT_EQ(ortung({"check", path("back.rec"), "--robot", path("back.toml")}).exitCode, 0);
}

// pf-localization takes the first column for times only where neither of the first two is whole.
TEST_F(Export, TruthHasEachPoseAndBeginsWithNoWholeSecond) {
  const auto expectTruth = [this] {
    ASSERT_EQ(
        ortung({"export", "rawlog", "record:" + path("run.rec"), "--robot", path("robot.toml"),
                "--out", path("run.rawlog"), "--truth", path("truth.txt"), "--force"})
            .exitCode,
        0);
    const auto poses = readingsOf("run.rec", {"reference", "groundTruth", "pose"});
    ASSERT_FALSE(poses.empty());
    std::istringstream lines(read("truth.txt"));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      SCOPED_TRACE(i);
      double seconds = 0.0;
      Pose2 pose;
      ASSERT_TRUE(lines >> seconds >> pose.x >> pose.y >> pose.theta);
      const bool isShifted = i < 2 && poses[i].stamp % 1'000'000 == 0;
      EXPECT_EQ(std::llround(seconds * 1e6), poses[i].stamp + (isShifted ? 1 : 0));
      PoseData there(poses[i].id);
      there.setData(poses[i].stamp, poses[i].words);
      EXPECT_NEAR(pose.x, there.reading().x, 5.1e-5);  // four digits
      EXPECT_NEAR(pose.y, there.reading().y, 5.1e-5);
      EXPECT_NEAR(pose.theta, there.reading().theta, 5.1e-7);
    }
    std::string more;
    EXPECT_FALSE(lines >> more) << more;
  };
  recordRun();
  expectTruth();
  // Without all poses but those of whole seconds, then but the first of them.
  const std::string all = read("run.rec");
  for (const std::size_t most : {std::size_t{20}, std::size_t{1}}) {
    std::string text;
    std::size_t kept = 0;
    std::istringstream lines(all);
    for (std::string line; std::getline(lines, line);) {
      if (line.find("/groundTruth/") != line.npos && line[0] != '#' &&
          (std::stoll(line) % 1'000'000 != 0 || kept++ >= most))
        continue;
      text += line + "\n";
    }
    ASSERT_GE(kept, most);
    write("run.rec", text);
    expectTruth();
  }
}

TEST_F(Export, RawlogHasWhatRawlogEditCounts) {
  if (!isThere("rawlog-edit")) GTEST_SKIP() << "rawlog-edit of MRPT is not here";
  exportRun();
  const std::string info = run("rawlog-edit --info -i run.rawlog");
  const auto expected = [&](const SensorId& id) {
    std::ostringstream line;
    line << toText(id) << " / "
         << std::string(6 - std::to_string(readingsOf("run.rec", id).size()).size(), ' ')
         << readingsOf("run.rec", id).size() << " /";
    return line.str();
  };
  EXPECT_NE(info.find(expected(kScan)), info.npos) << info << expected(kScan);
  EXPECT_NE(info.find(expected(kOdometry)), info.npos) << info << expected(kOdometry);
  const std::size_t all =
      readingsOf("run.rec", kScan).size() + readingsOf("run.rec", kOdometry).size();
  EXPECT_NE(info.find("Overall number of objects         : " + std::to_string(all) + "\n"),
            info.npos)
      << info;
}

/// Settings of pf-localization that matter; it starts anywhere in the half of the hall where the
/// robot does, heading anywhere.
std::string settings(const std::string& folder) {
  return "[KLD_options]\nKLD_binSize_PHI_deg=10\nKLD_binSize_XY=0.10\nKLD_delta=0.01\n"
         "KLD_epsilon=0.01\nKLD_maxSampleSize=20000\nKLD_minSampleSize=300\nKLD_minSamplesPerBin="
         "0\n"
         "[PF_options]\nPF_algorithm=0\nresamplingMethod=0\nadaptiveSampleSize=1\nBETA=0.5\n"
         "sampleSize=1\n"
         "[DummyOdometryParams]\nminStdXY=0.02\nminStdPHI=1.0\n"
         "[LocalizationExperiment]\nuse_3D_poses=false\nmap_file=" +
         folder +
         "/hall.gridmap\n"
         "rawlog_file=" +
         folder + "/run.rawlog\nlogOutput_dir=" + folder +
         "/LOG\n"
         "3DSceneFrequency=100000\nexperimentRepetitions=1\nparticles_count=5000\n"
         "ground_truth_path_file=" +
         folder +
         "/truth.txt\ninit_PDF_mode=0\n"
         "init_PDF_min_x=-1\ninit_PDF_max_x=1\ninit_PDF_min_y=-1\ninit_PDF_max_y=1\n"
         "SHOW_PROGRESS_3D_REAL_TIME=false\nSAVE_STATS_ONLY=1\n"
         "[MetricMap]\noccupancyGrid_count=1\nlikelihoodMapSelection=-1\n"
         "[MetricMap_occupancyGrid_00_creationOpts]\nresolution=0.05\n"
         "[MetricMap_occupancyGrid_00_likelihoodOpts]\nlikelihoodMethod=4\nLF_decimation=2\n"
         "LF_stdHit=0.10\nLF_maxCorrsDistance=0.30\nLF_zHit=0.999\nLF_zRandom=0.001\n"
         "LF_maxRange=80\n";
}

TEST_F(Export, RunAndMapLetPfLocalizationFindTheRobot) {
  if (!isThere("pf-localization")) GTEST_SKIP() << "pf-localization of MRPT is not here";
  exportRun();
  const Outcome map = ortung({"export", "map", path("hall.toml"), "--out", path("hall.gridmap")});
  ASSERT_EQ(map.exitCode, 0) << map.err;
  write("pf.ini", settings(folder_.string()));
  // It takes its seed from the clock, and begins elsewhere once in some twenty runs.
  double worst = 0.0;
  for (int tries = 0; tries < 3; ++tries) {
    fs::remove_all(folder_ / "LOG_000_0005000");
    const std::string said = run("timeout 300 pf-localization pf.ini");
    std::istringstream errors(read("LOG_000_0005000/GT_error.txt"));
    std::vector<double> metres;
    for (double error = 0.0; errors >> error;) metres.push_back(error);
    ASSERT_GT(metres.size(), 100u) << said;
    worst = *std::max_element(metres.begin() + static_cast<std::ptrdiff_t>(metres.size() / 2),
                              metres.end());
    if (worst < 0.2) break;
  }
  EXPECT_LT(worst, 0.2) << "a second method, on cells of 0.05 m";
}

TEST_F(Export, MapOfAWorldIsReadBackAsTheSameWorld) {
  ASSERT_EQ(ortung({"export", "map", path("hall.toml"), "--out", path("hall.yaml")}).exitCode, 0);
  EXPECT_TRUE(read("hall.pgm").starts_with("P5\n"));
  write("drawn.toml", "[world]\nname = \"drawn\"\n\n[[grid]]\nmap = \"hall.yaml\"\n");
  const Outcome drawn = ortung({"check", path("drawn.toml")});
  EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
  // Learned of one, a run in the other is localized.
  recordRun();
  ASSERT_EQ(ortung({"learn", "--world", path("drawn.toml"), "--robot", path("robot.toml"), "--out",
                    path("drawn.ortung")})
                .exitCode,
            0);
  const Outcome eval = ortung({"eval", "--source", "record:" + path("run.rec"), "--robot",
                               path("robot.toml"), "--tables", path("drawn.ortung"), "--start",
                               "truth", "--any-world", "--json", path("o.json")});
  ASSERT_EQ(eval.exitCode, 0) << eval.err;
  const std::string json = read("o.json");
  const std::size_t at = json.find("\"position_rmse_m\": ");
  ASSERT_NE(at, json.npos);
  EXPECT_LT(std::stod(json.substr(at + 19)), 0.15);
}

TEST_F(Export, McapComesBackAsTheSameRecordAndTheSameRobot) {
  recordRun();
  const Outcome out =
      ortung({"export", "mcap", "record:" + path("run.rec"), "--robot", path("robot.toml"),
              "--world", path("hall.toml"), "--out", path("run.mcap")});
  ASSERT_EQ(out.exitCode, 0) << out.err;
  EXPECT_NE(out.out.find("/scan "), out.out.npos) << out.out;
  const Outcome in = ortung({"import", "mcap", path("run.mcap"), "--out", path("back.rec"),
                             "--robot-file", path("back.toml"), "--world", path("back_hall.toml")});
  ASSERT_EQ(in.exitCode, 0) << in.err;
  EXPECT_EQ(read("back.toml"), read("robot.toml"));
  for (const SensorId& id : {kScan, kOdometry, SensorId{"reference", "groundTruth", "pose"}}) {
    const auto there = readingsOf("run.rec", id);
    ASSERT_GT(there.size(), 100u);
    EXPECT_EQ(there, readingsOf("back.rec", id)) << toText(id);
  }
  // What is solid in the world's map is solid in the hall.
  EXPECT_EQ(ortung({"learn", "--world", path("back_hall.toml"), "--robot", path("robot.toml"),
                    "--out", path("back.ortung")})
                .exitCode,
            0);
}

TEST_F(Export, McapOfTablesHasTheirOpenCellsAsItsMap) {
  recordRun();
  learnTables();
  const auto exported = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{
        "export",           "mcap",     "record:" + path("run.rec"), "--robot",
        path("robot.toml"), "--tables", path("hall.ortung"),         "--out",
        path("run.mcap")};
    words.insert(words.end(), more.begin(), more.end());
    return ortung(words);
  };
  const Outcome out = exported({"--map-frame", "none"});
  ASSERT_EQ(out.exitCode, 0) << out.err;
  EXPECT_NE(out.out.find("/map "), out.out.npos) << out.out;
  EXPECT_EQ(exported({"--world", path("hall.toml")}).exitCode, 2);
  EXPECT_EQ(exported({"--map-frame", "moon"}).exitCode, 2);
  write("run.mcap", "my own");
  expectRefused(exported({}), 1, "ortung export mcap: " + path("run.mcap"), {"--force"});
}

TEST_F(Export, SaysWhatIsWrong) {
  recordRun();
  expectRefused(ortung({"export", "map", path("hall.toml"), "--out", path("hall.png")}), 2,
                "ortung export map: --out is", {"NAME.yaml or NAME.gridmap"});
  write("deaf.toml", "[robot]\nradius_m = 0.2\n\n[[sensor]]\nplugin = \"compass\"\n");
  const Outcome deaf = ortung({"export", "rawlog", "record:" + path("run.rec"), "--robot",
                               path("deaf.toml"), "--out", path("run.rawlog")});
  EXPECT_EQ(deaf.exitCode, 1);
  EXPECT_NE(deaf.err.find("holds no reading that a rawlog can hold"), deaf.err.npos) << deaf.err;
  EXPECT_FALSE(fs::exists(path("run.rawlog")));
  write("mine.rawlog", "my own");
  expectRefused(ortung({"export", "rawlog", "record:" + path("run.rec"), "--robot",
                        path("robot.toml"), "--out", path("mine.rawlog")}),
                1, "ortung export rawlog: " + path("mine.rawlog"), {"--force"});
}

}  // namespace
}  // namespace ortung::test

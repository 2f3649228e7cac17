#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

/// eval and localize on a recorded run.
class Localization : public Workspace {
 protected:
  Localization() {
    learnTables();
    recordRun();
  }
  Outcome run(const std::string& command, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        command,    "--source",         "record:" + path("run.rec"), "--robot", path("robot.toml"),
        "--tables", path("hall.ortung")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }
};

TEST_F(Localization, EvalTracksFromAKnownStartAndWritesAllItsFiles) {
  const Outcome outcome = run("eval", {"--start", "truth", "--json", path("o.json"), "--report",
                                       path("o.html"), "--record", path("o.txt")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const auto json = nlohmann::json::parse(read("o.json"));
  EXPECT_GT(json["steps"].get<int>(), 30);
  EXPECT_NEAR(json["duration_s"].get<double>(), 20.0, 0.2);
  EXPECT_LT(json["position_rmse_m"].get<double>(), 0.15);  // cells are 0.1 m, noise 0.05 m
  EXPECT_LT(json["heading_rmse_deg"].get<double>(), 5.0);
  EXPECT_NE(outcome.out.find("Position error, RMS"), std::string::npos);
  EXPECT_TRUE(read("o.html").starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(read("o.txt"), read("run.rec"));
}

// Scans every 3 s, and 5 s without any reading: between scans odometry alone says where the robot
// is.
// The viewer localizes the record again, as it was told for the evaluation.
TEST_F(Localization, EvalShowsItsRunInTheViewer) {
  const std::string source = "record:" + path("run.rec");
  Program program({"eval", "--source", source, "--robot", path("robot.toml"), "--tables",
                   path("hall.ortung"), "--seed", "5", "--progress", "--view"});
  const std::string said = program.waitForOutput("view and control: ");
  program.signal(SIGINT);
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_LT(said.find("Position error, RMS"), said.find("listening on ")) << said;
  EXPECT_NE(outcome.err.find("localizing " + source + " ["), std::string::npos) << outcome.err;
}

TEST_F(Localization, ReportDrawsTheEstimateWhereItIsComparedAndBreaksItAtGaps) {
  std::istringstream lines(read("run.rec"));
  std::string rare;
  double nextScan = 0.0;
  for (std::string line; std::getline(lines, line);) {
    const bool isReading = !line.starts_with('#');
    const double seconds = isReading ? std::stod(line) / 1e6 : 0.0;
    if (seconds > 8.0 && seconds < 13.0) continue;
    if (isReading && line.find("/LRF/") != line.npos) {
      if (seconds < nextScan) continue;
      nextScan = seconds + 3.0;
    }
    rare += line + "\n";
  }
  write("run.rec", rare);
  const Outcome outcome = run("eval", {"--start", "truth", "--report", path("o.html")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::string html = read("o.html");
  const auto between = [&](const std::string& begin, const std::string& end) {
    const std::size_t from = html.find(begin) + begin.size();
    return html.substr(from, html.find(end, from) - from);
  };
  const auto data = nlohmann::json::parse(between("id=\"data\">", "</script>"));
  std::string estimate = between("class=\"estimate\" d=\"", "\"");
  const std::string truth = between("class=\"truth\" d=\"", "\"");
  EXPECT_EQ(std::count(truth.begin(), truth.end(), 'M'), 2);
  EXPECT_EQ(std::count(estimate.begin(), estimate.end(), 'M'), 2)
      << "it breaks where the truth does";
  for (std::size_t at; (at = estimate.find_first_of("MLh")) != estimate.npos;)
    estimate.replace(at, estimate[at] == 'h' ? 2 : 1, " ");
  std::istringstream words(estimate);
  std::vector<std::pair<double, double>> drawn;
  for (double x, y; words >> x >> y;) drawn.emplace_back(x, y);
  const std::size_t compared = data["estimateX"].size();
  EXPECT_GT(compared, 130u);
  for (std::size_t i = 0; i < compared; ++i) {
    double nearest = 1.0;
    for (const auto& [x, y] : drawn)
      nearest = std::min(nearest, std::hypot(x - data["estimateX"][i].get<double>(),
                                             y - data["estimateY"][i].get<double>()));
    EXPECT_LT(nearest, 0.002) << "at " << data["time"][i] << " s";
  }
}

TEST_F(Localization, SameSeedGivesTheSamePosesWhateverTheThreads) {
  const Outcome one = run("localize", {"--seed", "5", "--threads", "1"});
  const Outcome two = run("localize", {"--seed", "5", "--threads", "2"});
  ASSERT_EQ(one.exitCode, 0) << one.err;
  EXPECT_EQ(one.out, two.out);
  EXPECT_NE(one.out, run("localize", {"--seed", "6"}).out);
}

TEST_F(Localization, LocalizeWritesTimedPosesWithCovariance) {
  const Outcome outcome = run("localize", {"--out", path("poses.txt")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  std::istringstream lines(read("poses.txt"));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_TRUE(line.starts_with("# stamp_us x_m y_m theta_rad")) << line;
  long long last = -1;
  std::size_t count = 0;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    long long stamp = 0;
    double number = 0.0;
    std::size_t numbers = 0;
    words >> stamp;
    EXPECT_GT(stamp, last);
    last = stamp;
    while (words >> number) ++numbers;
    EXPECT_EQ(numbers, 11u) << line;  // pose, six of the covariance, share, samples
    ++count;
  }
  EXPECT_GT(count, 30u);
}

TEST_F(Localization, LocalizeNeverLooksAtGroundTruth) {
  const std::string with = run("localize").out;
  std::istringstream lines(read("run.rec"));
  std::string blind;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("/groundTruth/") == std::string::npos) blind += line + "\n";
  }
  write("run.rec", blind);
  EXPECT_EQ(run("localize").out, with);
}

TEST_F(Localization, EvalWithoutGroundTruthSaysSoAndWritesNull) {
  std::istringstream lines(read("run.rec"));
  std::string blind;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("/groundTruth/") == std::string::npos) blind += line + "\n";
  }
  write("run.rec", blind);
  const Outcome outcome = run("eval", {"--json", path("o.json"), "--report", path("o.html")});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("no ground truth"), std::string::npos) << outcome.err;
  const auto json = nlohmann::json::parse(read("o.json"));
  EXPECT_TRUE(json["position_rmse_m"].is_null());
  EXPECT_EQ(json["compared_steps"], 0);
  expectRefused(run("eval", {"--start", "truth"}), 1, "ortung eval: record:", {"no ground truth"});
}

TEST_F(Localization, FeaturesTheRobotLacksAreNamedOnce) {
  std::string text = read("run.rec");
  const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  const std::string stamp = last.substr(0, last.find(' '));
  for (int i = 0; i < 3; ++i) text += stamp + " gps/GNSS/fix 1 7\n";
  write("run.rec", text);
  const Outcome outcome = run("localize", {"--out", path("poses.txt")});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("gps/GNSS/fix (3 readings)"), std::string::npos) << outcome.err;
}

TEST_F(Localization, TornRecordIsReadUpToItsLastWholeMomentAndSaidToBeTorn) {
  const std::string text = read("run.rec");
  const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  const std::string moment = "\n" + last.substr(0, last.find(' ') + 1);
  write("run.rec", text.substr(0, text.find(moment) + 1));
  const Outcome whole = run("localize");
  write("run.rec", text.substr(0, text.size() - 5));
  const Outcome outcome = run("localize");
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.out, whole.out);
  EXPECT_NE(outcome.err.find("warning: " + path("run.rec") + " is torn: its last "),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(run("eval", {"--record", path("o.txt")}).exitCode, 0);
  EXPECT_EQ(read("o.txt"), text.substr(0, text.find(moment) + 1));
}

TEST_F(Localization, ForeignLineIsRefusedWithItsNumberAndOldResultsStay) {
  const std::string old = R"({"compared_steps": 0})";
  write("o.json", old);
  std::string text = read("run.rec");
  write("run.rec", text.insert(text.rfind('\n', text.size() / 2) + 1, "FLASER 180 1.0 2.0\n"));
  expectRefused(run("eval", {"--json", path("o.json"), "--record", path("o.txt")}), 1,
                "ortung eval: " + path("run.rec") + ":", {"FLASER"});
  EXPECT_EQ(read("o.json"), old);
  EXPECT_FALSE(std::filesystem::exists(path("o.txt")));
}

// The run begins at 0, 0 and 30 degrees, and so narrow a start can't be anywhere else at once.
TEST_F(Localization, StartTakesItsHeadingInDegrees) {
  const Outcome outcome = run("localize", {"--start", "0,0,30", "--start-sigma", "0.05,1"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  std::istringstream line(outcome.out.substr(outcome.out.find('\n') + 1));
  double stamp = 0;
  double x = 0;
  double y = 0;
  double theta = 0;
  line >> stamp >> x >> y >> theta;
  EXPECT_NEAR(x, 0.0, 0.3);
  EXPECT_NEAR(y, 0.0, 0.3);
  EXPECT_NEAR(theta, 0.5236, 0.09);
}

TEST_F(Localization, ReadingThatIsNoNumberIsRefused) {
  std::string text = read("run.rec");
  text.replace(text.rfind(' '), text.npos, " nan\n");
  write("run.rec", text);
  expectRefused(run("eval"), 1, "ortung eval: " + path("run.rec") + ":", {"'nan'"});
}

TEST_F(Localization, ReadingOfAnotherShapeIsRefusedWithTimeAndFeature) {
  std::string text = read("run.rec");
  const std::size_t scan = text.find(" LMS200/LRF/180DegreeScan ", text.rfind("\n# ")) + 1;
  const std::size_t end = text.find('\n', scan);
  write("run.rec", text.replace(scan, end - scan, "LMS200/LRF/180DegreeScan 2 1000 1000"));
  expectRefused(run("eval"), 1,
                "ortung eval: record:", {" us: ", "LMS200/LRF/180DegreeScan", "60"});
}

TEST_F(Localization, TruncatedTablesAreRefused) {
  std::string bytes = read("hall.ortung");
  write("hall.ortung", bytes.substr(0, bytes.size() / 2));
  expectRefused(run("eval"), 1, "ortung eval: " + path("hall.ortung"), {});
  bytes[bytes.size() / 3] = static_cast<char>(bytes[bytes.size() / 3] ^ 1);
  write("hall.ortung", bytes);
  expectRefused(run("eval"), 1, "ortung eval: " + path("hall.ortung"), {});
}

TEST_F(Localization, TablesOfAnotherRobotAreRefusedWithBothSettings) {
  replace("robot.toml", "fov_deg = 180", "fov_deg = 200");
  expectRefused(run("eval"), 1, "ortung eval: " + path("hall.ortung"),
                {"LMS200/LRF/180DegreeScan"});
  EXPECT_EQ(run("eval", {"--any-world"}).exitCode, 1);
}

TEST_F(Localization, TablesOfAnotherWorldAreRefusedUnlessAskedFor) {
  replace("hall.toml", "center_m = [2.4, -1.0]", "center_m = [2.3, -1.0]");
  learnTables();
  expectRefused(run("eval"), 1, "ortung eval: record:" + path("run.rec"),
                {"was learned in the world", "--any-world"});
  const Outcome outcome = run("eval", {"--any-world"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("warning"), std::string::npos);
}

TEST_F(Localization, SourcesWithUnknownKindOrOptionAreRefused) {
  const auto with = [&](const std::string& source) {
    return ortung({"eval", "--source", source, "--robot", path("robot.toml"), "--tables",
                   path("hall.ortung")});
  };
  expectRefused(with(path("none.rec")), 2, "ortung eval: source", {"KIND:PATH"});
  expectRefused(
      with("telepathy:x"), 1,
      "ortung eval: telepathy:x: there is no kind of source 'telepathy', expected one of ",
      {"carmen", "record", "sim", "tcp"});
  expectRefused(with("record:" + path("run.rec") + "?speed=2"), 2,
                "ortung eval: record:", {"speed"});
  expectRefused(with("sim:" + path("hall.toml") + "?sped=2"), 1, "ortung eval: sim:", {"sped"});
}

}  // namespace
}  // namespace ortung::test

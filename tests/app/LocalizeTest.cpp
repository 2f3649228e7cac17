// Poses at an even rate, as JSON, and a belief that outlives the program.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "Workspace.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;
using Line = std::vector<double>;

constexpr std::size_t kShare = 10;  ///< columns, from 0
constexpr std::size_t kAge = 12;

std::vector<Line> linesOf(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    lines.emplace_back();
    for (std::string word; words >> word;) lines.back().push_back(std::stod(word));
  }
  return lines;
}

class Localize : public Workspace {
 protected:
  Localize() {
    learnTables();
    recordRun();
    readTruth();
  }
  void readTruth() {
    RecordSource source(path("run.rec"));
    PoseData data({"any", "groundTruth", "pose"});
    for (Message message; source.next(message);) {
      if (message.id.type != "groundTruth") continue;
      data.setData(message.stamp, message.words);
      truth_[message.stamp] = data.reading();
    }
  }
  Outcome run(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "localize",         "--source", "record:" + path("run.rec"), "--robot",
        path("robot.toml"), "--tables", path("hall.ortung")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }
  /// Leaves the readings for which @p keep(seconds, line) holds.
  template <class Keep>
  void thin(const std::string& to, const Keep& keep) const {
    std::istringstream lines(read("run.rec"));
    std::string kept;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with('#') || keep(std::stod(line) / 1e6, line)) kept += line + "\n";
    write(to, kept);
  }
  double error(const Line& line) const {
    const auto after = truth_.lower_bound(static_cast<Timestamp>(line[0]));
    if (after == truth_.end()) return 0.0;
    return std::hypot(line[1] - after->second.x, line[2] - after->second.y);
  }
  std::map<Timestamp, Pose2> truth_;
};

// Scans every 3 s: in between odometry leads, and the last column tells how long ago the last one
// was.
TEST_F(Localize, WritesPosesAtAnEvenRateWithTheAgeOfTheLastWeighing) {
  double nextScan = 0.0;
  thin("run.rec", [&](double seconds, const std::string& line) {
    if (line.find("/LRF/") == line.npos) return true;
    if (seconds < nextScan) return false;
    nextScan = seconds + 3.0;
    return true;
  });
  const Outcome outcome = run({"--start", "truth", "--start-sigma", "0.05,2", "--rate", "25"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_TRUE(
      outcome.out.substr(0, outcome.out.find('\n')).ends_with(" share samples age_s quality"));
  const std::vector<Line> lines = linesOf(outcome.out);
  const auto first = static_cast<double>(truth_.begin()->first);
  const double seconds = static_cast<double>(truth_.rbegin()->first) / 1e6 - first / 1e6;
  EXPECT_EQ(lines.size(), static_cast<std::size_t>(std::floor(25 * seconds + 1e-9)) + 1);
  double oldest = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ASSERT_EQ(lines[i].size(), 14U);
    EXPECT_EQ(lines[i][0], first + 40'000.0 * static_cast<double>(i));
    EXPECT_LT(error(lines[i]), 0.3) << i;
    EXPECT_GE(lines[i][kAge], 0.0);
    EXPECT_LE(lines[i][kAge], 3.2);
    oldest = std::max(oldest, lines[i][kAge]);
  }
  EXPECT_GT(oldest, 2.7);
  // One line a weighing without it, with the columns of ever.
  const std::vector<Line> weighed = linesOf(run({"--start", "truth"}).out);
  EXPECT_LT(weighed.size(), 10U);
  EXPECT_EQ(weighed.front().size(), 12U);
}

// What evo would compute from the files, here by itself: absolute errors of positions and headings
// beside the truth, which is interpolated; eval's figures must be the same.
TEST_F(Localize, WritesPosesAndTruthFromWhichEvalsFiguresFollow) {
  const Outcome outcome =
      run({"--start", "truth", "--start-sigma", "0.05,2", "--rate", "10", "--format", "tum",
           "--out", path("poses.tum"), "--truth", path("truth.tum")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::vector<Line> truth = linesOf(read("truth.tum"));
  ASSERT_EQ(truth.size(), truth_.size());
  const auto headingOf = [](const Line& line) { return 2 * std::atan2(line[6], line[7]); };
  std::vector<double> errors;
  double squares = 0.0;
  double turns = 0.0;
  std::size_t behind = 0;
  for (const Line& pose : linesOf(read("poses.tum"))) {
    ASSERT_EQ(pose.size(), 8U);
    while (behind < truth.size() && truth[behind][0] < pose[0] - 1e-9) ++behind;
    if (behind == truth.size()) break;
    const Line& b = truth[behind];
    const Line& a = truth[behind == 0 ? 0 : behind - 1];
    const double share = b[0] > a[0] ? (pose[0] - a[0]) / (b[0] - a[0]) : 1.0;
    const double error =
        std::hypot(pose[1] - a[1] - share * (b[1] - a[1]), pose[2] - a[2] - share * (b[2] - a[2]));
    const double turn =
        headingOf(a) + share * std::remainder(headingOf(b) - headingOf(a), 2 * M_PI);
    errors.push_back(error);
    squares += error * error;
    turns += std::pow(std::remainder(headingOf(pose) - turn, 2 * M_PI), 2);
  }
  ASSERT_GT(errors.size(), 190U);
  std::sort(errors.begin(), errors.end());
  const std::size_t n = errors.size();
  const auto count = static_cast<double>(n);
  const double median = (errors[(n - 1) / 2] + errors[n / 2]) / 2;

  const Outcome eval = ortung({"eval", "--source", "record:" + path("run.rec"), "--robot",
                               path("robot.toml"), "--tables", path("hall.ortung"), "--start",
                               "truth", "--start-sigma", "0.05,2", "--json", path("figures.json")});
  ASSERT_EQ(eval.exitCode, 0) << eval.err;
  const auto figures = nlohmann::json::parse(read("figures.json"));
  ASSERT_EQ(figures.at("converged_after_s"), 0.0);
  ASSERT_NEAR(figures.at("compared_moments").get<double>(), count, 1.0);  // the last one
  EXPECT_NEAR(figures.at("position_median_m").get<double>(), median, 2e-4);
  // One moment more or less.
  EXPECT_NEAR(figures.at("position_rmse_m").get<double>(), std::sqrt(squares / count), 3e-4);
  EXPECT_NEAR(figures.at("heading_rmse_deg").get<double>(), std::sqrt(turns / count) * 180 / M_PI,
              2e-3);
}

TEST_F(Localize, WritesTheSameAsJson) {
  const std::vector<std::string> none;
  for (const std::vector<std::string>& rate : {none, {"--rate", "7.5"}}) {
    std::vector<std::string> json = {"--format", "json", "--start", "truth"};
    std::vector<std::string> text = {"--format", "text", "--start", "truth"};
    for (auto* arguments : {&json, &text})
      arguments->insert(arguments->end(), rate.begin(), rate.end());
    const Outcome outcome = run(json);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::vector<Line> lines = linesOf(run(text).out);
    std::istringstream in(outcome.out);
    std::size_t i = 0;
    for (std::string line; std::getline(in, line); ++i) {
      const auto pose = nlohmann::json::parse(line);
      ASSERT_LT(i, lines.size());
      EXPECT_EQ(pose["stamp_us"].get<double>(), lines[i][0]);
      EXPECT_NEAR(pose["x_m"].get<double>(), lines[i][1], 6e-5);
      EXPECT_NEAR(pose["y_m"].get<double>(), lines[i][2], 6e-5);
      EXPECT_NEAR(pose["theta_rad"].get<double>(), lines[i][3], 6e-6);
      const std::array<std::array<std::size_t, 3>, 3> columns = {{{4, 5, 6}, {5, 7, 8}, {6, 8, 9}}};
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column) {
          const double expected = lines[i][columns[row][column]];
          EXPECT_NEAR(pose["covariance"][row][column].get<double>(), expected,
                      1e-5 * std::abs(expected) + 1e-12);
        }
      EXPECT_NEAR(pose["share"].get<double>(), lines[i][kShare], 6e-4);
      EXPECT_EQ(pose["samples"].get<double>(), lines[i][kShare + 1]);
      EXPECT_NEAR(pose["age_s"].get<double>(), rate.empty() ? 0.0 : lines[i][kAge], 6e-4);
    }
    EXPECT_EQ(i, lines.size());
    EXPECT_GT(i, 30U);
  }
}

TEST_F(Localize, ReplacesPosesOfTheSameFormatOnly) {
  for (const auto& [format, other] : {std::pair("json", "text"), std::pair("text", "json")}) {
    fs::remove(path("poses"));
    const std::vector<std::string> same = {"--format", format, "--out", path("poses")};
    EXPECT_EQ(run(same).exitCode, 0);
    EXPECT_EQ(run(same).exitCode, 0);
    expectRefused(run({"--format", other, "--out", path("poses")}), 1,
                  "ortung localize: " + path("poses"), {"--force"});
  }
}

TEST_F(Localize, WrongRatesAndFormatsAreUsageErrors) {
  expectRefused(run({"--rate", "0"}), 2, "ortung localize: --rate", {"0.01 to 1000"});
  expectRefused(run({"--rate", "nan"}), 2, "ortung localize: --rate", {"'nan'"});
  expectRefused(run({"--format", "xml"}), 2, "ortung localize: --format", {"xml"});
}

// The robot is switched off half way and goes on from the same place: the hall is searched once.
TEST_F(Localize, GoesOnWithTheBeliefOfTheRunBefore) {
  const double half = static_cast<double>(truth_.rbegin()->first) / 2e6;
  thin("first", [&](double seconds, const std::string&) { return seconds < half; });
  thin("second", [&](double seconds, const std::string&) { return seconds >= half; });
  write("run.rec", read("first"));
  const Outcome first = run({"--belief", path("belief"), "--start", "truth"});
  ASSERT_EQ(first.exitCode, 0) << first.err;
  const TableFile saved(path("belief"));
  const auto x = saved.get<float>("x", {0});
  ASSERT_GE(x.size(), 100U);
  EXPECT_EQ(static_cast<Timestamp>(saved.get<double>("stamp_us", {1})[0]),
            std::prev(truth_.lower_bound(static_cast<Timestamp>(half * 1e6)))->first);
  const std::string bytes = read("belief");

  write("run.rec", read("second"));
  const Outcome second = run({"--belief", path("belief"), "--rate", "10"});
  ASSERT_EQ(second.exitCode, 0) << second.err;
  for (const Line& line : linesOf(second.out)) EXPECT_LT(error(line), 0.3) << line[0];
  EXPECT_LT(linesOf(second.out).front()[4], 0.1) << "it knew its place from the first pose on";
  EXPECT_FALSE(read("belief") == bytes) << "it is that of the end";
}

TEST_F(Localize, ABeliefThatCantBeUsedIsNamedAndStays) {
  ASSERT_EQ(run({"--belief", path("belief")}).exitCode, 0);
  const std::string good = read("belief");
  const auto refused = [&](const std::string& bytes, const std::string& reason) {
    write("belief", bytes);
    expectRefused(run({"--belief", path("belief")}), 1, "ortung localize: " + path("belief"),
                  {reason});
    EXPECT_TRUE(read("belief") == bytes) << reason;
  };
  refused("what somebody wrote", "exists and is not what --belief writes");
  refused(read("hall.ortung"), "exists and is not what --belief writes");
  refused(good.substr(0, good.size() / 2), "is torn");
  std::string turned = good;
  const std::size_t within = good.find("NUMPY", good.find("x.npy")) + 500;  // among the numbers
  turned[within] = static_cast<char>(turned[within] ^ 1);
  refused(turned, "is torn");
  // That of another world.
  write("belief", good);
  replace("hall.toml", "center_m = [2.4, -1.0]", "center_m = [2.3, -1.0]");
  learnTables();
  const Outcome other = run({"--belief", path("belief"), "--any-world"});
  EXPECT_EQ(other.exitCode, 1);
  EXPECT_NE(other.err.find("ortung localize: " + path("belief") + ": is a belief about the world"),
            std::string::npos)
      << other.err;
  EXPECT_TRUE(read("belief") == good);
}

TEST_F(Localize, NeitherWhatIsReadNorPosesAreTakenForTheBelief) {
  for (const std::string name : {"hall.ortung", "robot.toml", "run.rec"})
    expectRefused(run({"--belief", path(name)}), 2, "ortung localize: " + path(name),
                  {"is read by this run"});
  expectRefused(run({"--belief", path("new"), "--out", path("new")}), 2,
                "ortung localize: " + path("new"), {"name the same file"});
  expectRefused(run({"--belief", path("none/belief")}), 1,
                "ortung localize: ", {"there is no folder"});
}

TEST_F(Localize, ARecordHasReadingsAndResults) {
  const Outcome written = run({"--record", path("all.rec"), "--out", path("poses.txt")});
  ASSERT_EQ(written.exitCode, 0) << written.err;
  // It is a source like the first one: the same poses come of it.
  const Outcome again = ortung({"localize", "--source", path("all.rec"), "--robot",
                                path("robot.toml"), "--tables", path("hall.ortung")});
  ASSERT_EQ(again.exitCode, 0) << again.err;
  EXPECT_EQ(again.out, read("poses.txt"));
  // Each pose that was printed is in it, in the same order.
  RecordSource record(path("all.rec"));
  std::size_t poses = 0, readings = 0;
  Message message;
  while (record.next(message)) {
    if (message.id.model == "mcl")
      poses += message.id.feature == "pose" ? 1 : 0;
    else
      ++readings;
  }
  const std::string text = read("poses.txt");
  EXPECT_EQ(static_cast<std::ptrdiff_t>(poses), std::count(text.begin(), text.end(), '\n') - 1);
  RecordSource source(path("run.rec"));
  std::size_t given = 0;
  while (source.next(message)) ++given;
  EXPECT_EQ(readings, given);
  expectRefused(run({"--record", path("r"), "--filter", "grid"}), 2, "ortung localize: --record",
                {"--filter mcl"});
}

TEST_F(Localize, ABagIsLocalizedIntoABag) {
  ASSERT_EQ(run({"--record", path("all.rec"), "--seed", "7"}).exitCode, 0);
  const auto mcap = [&](const std::string& source, const std::string& out,
                        const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "export", "mcap",   source, "--robot", path("robot.toml"), "--tables", path("hall.ortung"),
        "--out",  path(out)};
    words.insert(words.end(), more.begin(), more.end());
    return ortung(words);
  };
  const Outcome recorded = mcap(path("all.rec"), "a.mcap", {});
  ASSERT_EQ(recorded.exitCode, 0) << recorded.err;
  const Outcome localized = mcap(path("run.rec"), "b.mcap", {"--localize", "--seed", "7"});
  ASSERT_EQ(localized.exitCode, 0) << localized.err;
  EXPECT_NE(localized.out.find("/particle_cloud"), std::string::npos) << localized.out;
  // As many messages of each topic as of the localized record. (Their bytes differ in how long
  // updates took.)
  const auto topics = [](const Outcome& outcome) {
    return outcome.out.substr(outcome.out.find(".mcap: "));
  };
  EXPECT_EQ(topics(localized), topics(recorded));
  const Outcome plain = mcap(path("run.rec"), "c.mcap", {});
  EXPECT_EQ(plain.out.find("/particle_cloud"), std::string::npos) << plain.out;
  expectRefused(ortung({"export", "mcap", path("run.rec"), "--robot", path("robot.toml"), "--out",
                        path("d.mcap"), "--localize"}),
                2, "ortung export mcap: --localize needs --tables", {});
}

TEST_F(Localize, SaysAtTheEndWhatItWrote) {
  const Outcome outcome =
      run({"--out", path("poses.txt"), "--record", path("all.rec"), "--truth", path("truth.txt")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::size_t poses = linesOf(read("poses.txt")).size();
  EXPECT_NE(outcome.err.find("ortung localize: " + path("poses.txt") + ": " +
                             std::to_string(poses) + " poses, "),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find(path("all.rec") + ": all readings, and the results of " +
                             std::to_string(poses) + " updates\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find(path("truth.txt") + ": "), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("updates long"), std::string::npos) << outcome.err;
}

// A second after a global start no metre has been driven, so nothing has confirmed the place.
TEST_F(Localize, SaysWhyAShortRunIsNotTracked) {
  thin("short.rec", [](double seconds, const std::string&) { return seconds < 1.0; });
  const Outcome outcome = ortung({"localize", "--source", "record:" + path("short.rec"), "--robot",
                                  path("robot.toml"), "--tables", path("hall.ortung")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::size_t updates = linesOf(outcome.out).size();
  EXPECT_NE(outcome.err.find("ortung localize: the run is " + std::to_string(updates) +
                             " updates long ("),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("few readings have confirmed the place yet; after a global start"),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace ortung::test

// Records on one page: their names, and what is refused.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "Workspace.hpp"
#include "ortung/formats/SamplesData.hpp"
#include "ortung/records/RecordSource.hpp"

namespace ortung::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class ExportedPage : public Workspace {
 protected:
  ExportedPage() {
    for (const char* name : {"run.rec", "my <log>!.rec"})
      write(name,
            "# ortung record 1\n1000000 reference/groundTruth/pose 3 100 200 18000\n3500000 "
            "reference/groundTruth/pose 3 150 200 18000\n");
  }
  Outcome exportPage(const Words& records, const Words& more = {}) const {
    Words command = {"export", "html"};
    command.insert(command.end(), records.begin(), records.end());
    command.insert(command.end(), {"--out", path("page.html")});
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  }
  Json told() const {
    const std::string page = read("page.html");
    const std::string begin = "<script id=\"run\" type=\"application/json\">";
    const std::size_t from = page.find(begin) + begin.size();
    return Json::parse(page.substr(from, page.find("</script>", from) - from));
  }
};

TEST_F(ExportedPage, RobotsAreCalledLikeTheirFilesAsTheProtocolAllows) {
  const Outcome outcome =
      exportPage({path("run.rec"), path("my <log>!.rec"), "record:" + path("run.rec")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json page = told();
  ASSERT_EQ(page["robots"].size(), 3u);
  EXPECT_EQ(page["robots"][0]["name"], "run");
  EXPECT_EQ(page["robots"][1]["name"], "my__log__");
  EXPECT_EQ(page["robots"][2]["name"], "run-2");
  EXPECT_EQ(page["end_us"], 2'500'000) << "times begin at zero";
  EXPECT_NE(read("page.html").find("<title>run.rec, my _log_!.rec, run.rec</title>"),
            std::string::npos);
  EXPECT_TRUE(outcome.out.starts_with(path("page.html") + ": 2.5 s of run.rec, my <log>!.rec"))
      << outcome.out;
}

TEST_F(ExportedPage, OfASourceOnlyThePartThatIsAskedForIsThere) {
  const Outcome outcome =
      exportPage({"record:" + path("run.rec") + "?to_s=1"}, {"--world", path("hall.toml")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(told()["end_us"], 0);
  EXPECT_FALSE(told()["field"].empty());
}

// A page has 300 samples of each belief, of all over the field as long as the robot may be
// anywhere.
TEST_F(ExportedPage, LocalizedRecordsHaveSamplesOfEachBelief) {
  learnTables();
  recordRun();
  const Outcome outcome = exportPage(
      {path("run.rec")}, {"--robot", path("robot.toml"), "--tables", path("hall.ortung")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  write("readings", told()["robots"][0]["readings"].get<std::string>());
  write("page.rec", "# ortung record 1\n");
  const std::string unpack = "base64 -d " + path("readings") + " | gunzip >> " + path("page.rec");
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  RecordSource source(path("page.rec"));
  std::vector<Timestamp> estimates;
  std::vector<Timestamp> beliefs;
  for (Message message; source.next(message);) {
    if (message.id == SensorId{"mcl", "LOCALIZATION", "pose"}) estimates.push_back(message.stamp);
    if (message.id != SensorId{"mcl", "LOCALIZATION", "samples"}) continue;
    beliefs.push_back(message.stamp);
    EXPECT_LE(message.words.size(), 300u * 4u);
    if (beliefs.size() > 1) continue;
    SamplesData samples;
    samples.setData(message.stamp, message.words);
    std::set<std::pair<double, double>> places;
    for (const auto& sample : samples.reading()) places.insert({sample.pose.x, sample.pose.y});
    EXPECT_GT(places.size(), 250u) << "of 300";
    EXPECT_LT(places.begin()->first, -2.0);
    EXPECT_GT(places.rbegin()->first, 2.0);
  }
  EXPECT_GT(estimates.size(), 100u);
  EXPECT_EQ(beliefs, estimates);
}

/// What a text of the page is, unpacked.
class Unpacked : public ExportedPage {
 protected:
  Json moment(const Json& one) const {
    write("moment", one["data"].get<std::string>());
    const std::string unpack = "base64 -d " + path("moment") + " | gunzip > " + path("moment.json");
    EXPECT_EQ(std::system(unpack.c_str()), 0);
    return Json::parse(read("moment.json"));
  }
};

// The hall's tables hold the robot file, so nothing else is needed.
TEST_F(Unpacked, MomentsHaveMapsAndReasons) {
  learnTables();
  recordRun();
  const Outcome outcome =
      exportPage({path("run.rec")}, {"--tables", path("hall.ortung"), "--maps", "3"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json run = told()["robots"][0];
  ASSERT_EQ(run["maps"].size(), 3u);
  EXPECT_EQ(run["maps"].back()["us"], told()["end_us"]) << "events, and evenly up to the end";
  const Json last = moment(run["maps"].back());
  const Json& map = last["maps"][0];
  EXPECT_EQ(map["feature"], "");
  EXPECT_EQ(map["scale"], "linear");
  EXPECT_EQ(last["maps"][1]["scale"], "log");
  EXPECT_GT(map["readings"], 0);
  const Json& why = last["why"];
  ASSERT_FALSE(why["features"].empty());
  // The first place is where the robot truly is: nowhere else is more probable.
  ASSERT_GT(why["places"].size(), 20u);
  const double there = why["places"][0]["p"];
  for (const Json& place : why["places"])
    EXPECT_LE(place["p"].get<double>(), 2.0 * there) << place["x"] << " " << place["y"];
  const Json& seen = why["features"][0];
  const Json& expected = why["places"][0]["expected"][0];
  ASSERT_EQ(seen["measured"].size(), expected.size());
  ASSERT_EQ(seen["angles"].size(), expected.size());
}

TEST_F(Unpacked, MapsNeedTablesAndAreLeftOutWhereNobodyWantsThem) {
  learnTables();
  recordRun();
  EXPECT_EQ(exportPage({path("run.rec")}, {"--maps", "2"}).exitCode, 2);
  ASSERT_EQ(
      exportPage({path("run.rec")}, {"--tables", path("hall.ortung"), "--maps", "0"}).exitCode, 0);
  EXPECT_TRUE(told()["robots"][0]["maps"].empty());
  // Without tables they are learned, if somebody wants maps.
  ASSERT_EQ(exportPage({path("run.rec")}, {"--robot", path("robot.toml"), "--world",
                                           path("hall.toml"), "--maps", "1", "--force"})
                .exitCode,
            0);
  EXPECT_EQ(told()["robots"][0]["maps"].size(), 1u);
}

TEST_F(ExportedPage, WhatCanNotBeShownIsNamedAndNothingWritten) {
  expectRefused(exportPage({path("none.rec")}), 2,
                "ortung export html: " + path("none.rec") + ": is neither a file nor a source", {});
  EXPECT_EQ(exportPage({path("hall.toml")}).exitCode, 1);
  EXPECT_FALSE(std::filesystem::exists(path("page.html")));
}

}  // namespace
}  // namespace ortung::test

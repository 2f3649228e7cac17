#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "Workspace.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/records/RecordSource.hpp"

namespace ortung::test {
namespace {

using Json = nlohmann::json;

/// eval of many runs and cases on a recorded run.
class EvalMany : public Workspace {
 protected:
  EvalMany() {
    learnTables();
    recordRun();
  }
  Outcome eval(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"eval",     "--robot",           path("robot.toml"),
                                          "--tables", path("hall.ortung"), "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }
  Json json(const std::string& name) const { return Json::parse(read(name)); }
  std::string source() const { return "record:" + path("run.rec"); }

  /// What does not depend on how busy the machine is.
  static Json withoutTimes(Json json) {
    for (const char* key : {"update_ms_p50", "update_ms_p99", "update_ms_max", "realtime_factor"})
      json.erase(key);
    return json;
  }
};

TEST_F(EvalMany, RunsAreThoseOfEachSeedByItselfWhateverTheThreads) {
  const std::vector<std::string> all = {"--source", source(), "--runs",  "3",
                                        "--seed",   "4",      "--fault", "readings=random:0.2"};
  for (const char* threads : {"1", "3"}) {
    std::vector<std::string> arguments = all;
    arguments.insert(arguments.end(), {"--threads", threads, "--json", path("all.json")});
    const Outcome outcome = eval(arguments);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(": 3 runs\n  with readings=random:0.2\n"), std::string::npos)
        << outcome.out;
    const Json runs = json("all.json")["runs"];
    ASSERT_EQ(runs.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ(eval({"--source", source(), "--seed", std::to_string(4 + i), "--fault",
                      "readings=random:0.2", "--json", path("one.json")})
                    .exitCode,
                0);
      EXPECT_EQ(withoutTimes(runs[i]), withoutTimes(json("one.json"))) << threads << " threads";
    }
  }
}

TEST_F(EvalMany, SummariesAreOfEachSource) {
  const std::string drive = "sim:" + path("hall.toml") + "?duration=12&seed=5";
  const Outcome outcome = eval({"--source", source(), "--source", drive, "--runs", "2", "--start",
                                "truth", "--json", path("all.json")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json all = json("all.json");
  ASSERT_EQ(all["summary"].size(), 2u);
  EXPECT_EQ(all["summary"][0]["source"], source());
  EXPECT_EQ(all["summary"][1]["source"], drive);
  for (const Json& summary : all["summary"]) {
    EXPECT_EQ(summary["kind"], "whole");
    EXPECT_EQ(summary["runs"], 2);
    EXPECT_EQ(summary["converged"]["count"], 2);
    EXPECT_EQ(summary["converged"]["of"], 2);
    EXPECT_NEAR(summary["converged"]["wilson95"][0].get<double>(), 0.3424, 1e-4);
    EXPECT_LE(summary["position_m"]["p50"], summary["position_m"]["p99"]);
    EXPECT_LE(summary["position_m"]["p99"], summary["position_m"]["max"]);
  }
  // The most of both runs is the larger one.
  EXPECT_NEAR(all["summary"][0]["position_m"]["max"].get<double>(),
              std::max(all["runs"][0]["position_max_m"].get<double>(),
                       all["runs"][1]["position_max_m"].get<double>()),
              1e-6);
}

TEST_F(EvalMany, KidnapsAndWakeUpsAreCasesWithVerdicts) {
  const Outcome outcome = eval({"--source", source(), "--kidnap", "2", "--wake-ups", "3",
                                "--converged-within", "0.3,10", "--json", path("o.json")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json all = json("o.json");
  ASSERT_EQ(all["runs"].size(), 5u);
  ASSERT_EQ(all["summary"].size(), 2u);
  EXPECT_EQ(all["summary"][0]["kind"], "kidnap");
  EXPECT_EQ(all["summary"][0]["right"]["of"], 2);
  EXPECT_EQ(all["summary"][1]["kind"], "wake-up");
  EXPECT_EQ(all["summary"][1]["right"]["of"], 3);
  for (std::size_t i = 0; i < 5; ++i) {
    const Json run = all["runs"][i];
    EXPECT_EQ(run["case"]["kind"], i < 2 ? "kidnap" : "wake-up");
    EXPECT_EQ(run["case"]["number"], i < 2 ? i + 1 : i - 1);
    EXPECT_EQ(run["seed"], run["case"]["number"]);
    ASSERT_EQ(run["case"]["events"].size(), 1u);
    const Json event = run["case"]["events"][0];
    EXPECT_EQ(event["right"].get<bool>(), !event["after_s"].is_null());
    EXPECT_LE(std::abs(event["x_m"].get<double>()), 3.0);
    EXPECT_EQ(event["right"].get<bool>(), event["after_readings"].is_number_unsigned());
  }
  EXPECT_NE(outcome.out.find("    kidnap 2 (seed 2), at "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("    wake-up 3 (seed 3), at "), std::string::npos) << outcome.out;
}

// A wake-up leaves the record as it is from a time on, so its figures can be counted in it.
TEST_F(EvalMany, EventsTellWhereAndAfterHowManyScans) {
  const SensorId scan{"LMS200", "LRF", "180DegreeScan"};
  const SensorId reference{"reference", "groundTruth", "pose"};
  ASSERT_EQ(eval({"--source", source(), "--wake-ups", "3", "--converged-within", "0.3,10", "--json",
                  path("o.json")})
                .exitCode,
            0);
  std::vector<Message> record;
  RecordSource file(path("run.rec"));
  for (Message message; file.next(message);) record.push_back(message);
  bool anyWithItsScan = false;
  const Json all = json("o.json");
  for (const Json& run : all["runs"]) {
    const Json event = run["case"]["events"][0];
    const Timestamp from = record.front().stamp + fromSeconds(event["at_s"].get<double>());
    const auto begin = std::ranges::find_if(record, [&](const Message& message) {
      return message.id == reference && message.stamp >= from;
    });
    ASSERT_NE(begin, record.end());
    PoseData truth(reference);
    truth.setData(begin->stamp, begin->words);
    // The first comparison is a tenth of a second later at most.
    EXPECT_NEAR(event["x_m"].get<double>(), truth.reading().x, 0.1);
    EXPECT_NEAR(event["y_m"].get<double>(), truth.reading().y, 0.1);
    ASSERT_TRUE(event["right"].get<bool>());
    const Timestamp until = from + fromSeconds(event["after_s"].get<double>());
    std::int64_t scans = 0;
    for (const Message& message : record) {
      if (message.id != scan || message.stamp < from || message.stamp > until) continue;
      ++scans;
      anyWithItsScan = anyWithItsScan || message.stamp == until;
    }
    EXPECT_EQ(event["after_readings"].get<std::int64_t>(), scans) << event;
  }
  EXPECT_TRUE(anyWithItsScan) << "the scan that has found the place counts, too";
}

// What eval makes of a source can be looked at, and be run again by itself.
TEST_F(EvalMany, OneCaseCanBeRecorded) {
  const Outcome outcome = eval({"--source", source(), "--kidnap", "1", "--seed", "2", "--record",
                                path("case.rec"), "--report", path("case.html")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_TRUE(isRecord(read("case.rec")));
  EXPECT_TRUE(read("case.html").starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(eval({"--source", "record:" + path("case.rec"), "--start", "truth"}).exitCode, 0);
}

TEST_F(EvalMany, TeleportsAreRunsWithEvents) {
  ASSERT_EQ(eval({"--source", source(), "--teleport", "2", "--runs", "3", "--json", path("o.json")})
                .exitCode,
            0);
  const Json all = json("o.json");
  ASSERT_EQ(all["runs"].size(), 3u);
  std::size_t events = 0;
  for (const Json& run : all["runs"]) {
    EXPECT_EQ(run["case"]["kind"], "teleports");
    events += run["case"]["events"].size();
  }
  EXPECT_EQ(all["summary"][0]["right"]["of"], events);
  EXPECT_GE(events, 2u);
}

TEST_F(EvalMany, ComparisonTellsWhatAFaultDoes) {
  const std::vector<std::string> runs = {"--source", source(), "--runs", "6", "--start", "truth"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = runs;
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(eval(arguments).exitCode, 0);
  };
  with({"--json", path("a.json")});
  // Samples all over the place, but not so far that a run would never converge.
  with({"--json", path("b.json"), "--motion", "0.5,0.5,0.5,0.5"});
  const Outcome outcome =
      ortung({"compare", path("a.json"), path("b.json"), "--json", path("c.json")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("6 pairs of runs\n")) << outcome.out;
  const Json comparison = json("c.json");
  const Json& figures = comparison["figures"];
  const auto median = std::ranges::find_if(
      figures, [](const Json& figure) { return figure["name"] == "position_median_m"; });
  ASSERT_NE(median, figures.end()) << comparison;
  EXPECT_EQ((*median)["worse"], 6);
  EXPECT_DOUBLE_EQ((*median)["p"].get<double>(), 2.0 / 64);
  EXPECT_EQ(ortung({"compare", path("b.json"), path("a.json"), "--json", path("c.json")}).exitCode,
            0)
      << "a comparison may be replaced";
  expectRefused(ortung({"compare", path("a.json"), path("b.json"), "--json", path("b.json")}), 2,
                "ortung compare: ", {"b.json"});
  with({"--json", path("d.json"), "--fault", "odometry=none"});
  expectRefused(ortung({"compare", path("a.json"), path("d.json")}), 1,
                "ortung compare: ", {"have no run in common"});
}

TEST_F(EvalMany, WhatMakesNoSenseIsWrongUsage) {
  const auto refused = [&](const std::vector<std::string>& more, const std::string& part) {
    std::vector<std::string> arguments = {"--source", source()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expectRefused(eval(arguments), 2, "ortung eval: ", {part});
  };
  refused({"--runs", "2", "--report", path("o.html")}, "--report is for one run, and there are 2");
  refused({"--wake-ups", "2", "--record", path("o.rec")}, "--record is for one run");
  refused({"--kidnap", "2", "--runs", "3"}, "leave out --runs");
  refused({"--kidnap", "2", "--start", "1,2,3"}, "kidnaps and teleports begin at the truth");
  refused({"--runs", "0"}, "--runs");
  refused({"--kidnap", "-1"}, "--kidnap");
  refused({"--teleport", "0"}, "--teleport");
}

TEST_F(EvalMany, SourcesThatCanNotBePlayedAgainAreRefused) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDWR);  // neither end waits for the other
  const std::string magic = "# ortung record 1\n0 a/b/c 0\n";
  ASSERT_EQ(::write(end, magic.data(), magic.size()), static_cast<ssize_t>(magic.size()));
  expectRefused(eval({"--source", "record:" + pipe, "--wake-ups", "2"}), 1,
                "ortung eval: record:", {"is live, so its readings come once"});
  ::close(end);
}

}  // namespace
}  // namespace ortung::test

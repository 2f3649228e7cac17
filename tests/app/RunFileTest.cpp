// What of a file of `ortung eval --json` is read, and where errors say that they are.
#include <gtest/gtest.h>

#include <cmath>

#include "Files.hpp"
#include "RunFile.hpp"

namespace ortung::app {
namespace {

class RunFile : public testing::Test {
 protected:
  std::vector<FiledRun> read(const std::string& text) const {
    test::writeBytes(folder_ / "x.json", text);
    return readRuns(folder_ / "x.json");
  }
  std::string refusal(const std::string& text) const {
    const std::string message = test::messageOf<std::runtime_error>([&] { read(text); });
    const std::string begin = (folder_ / "x.json").string();
    EXPECT_TRUE(message.starts_with(begin)) << message;
    return message.substr(begin.size());
  }
  test::TemporaryFolder folder_;
};

/// A run with further keys, which begin with a comma.
std::string runWith(const std::string& more) {
  return R"({"source": "a", "robot": "b", "seed": 1, "converged_after_s": null, "lost_share": 0.5,
             "position_median_m": 2)" +
         more + "}";
}

TEST_F(RunFile, NumbersAndNullsAreFiguresAndOtherThingsAreNot) {
  const FiledRun run =
      read(runWith(R"(, "extra": -1.5, "none": null, "text": "5", "list": [1], "yes": true)"))[0];
  EXPECT_EQ(run.figures.at("extra"), -1.5);
  EXPECT_EQ(run.figures.at("position_median_m"), 2.0);
  EXPECT_TRUE(std::isnan(run.figures.at("none")));
  EXPECT_TRUE(std::isnan(run.figures.at("converged_after_s")));
  for (const char* key : {"text", "list", "yes"}) EXPECT_FALSE(run.figures.contains(key)) << key;
}

TEST_F(RunFile, WhatEarlierVersionsLackIsAsItWasThen) {
  const FiledRun run = read(runWith(""))[0];
  EXPECT_EQ(run.start, "");
  EXPECT_TRUE(run.faults.empty());
  EXPECT_EQ(run.kind, "whole");
  EXPECT_EQ(run.number, 1u);
  EXPECT_TRUE(run.events.empty());
}

TEST_F(RunFile, CasesHaveTheirEvents) {
  const FiledRun run = read(runWith(R"(, "start": "truth", "case": {"kind": "wake-up", "number": 7,
      "events": [{"right": true, "after_s": 2.5, "after_readings": 9},
                 {"right": false, "after_s": null, "after_readings": null}]})"))[0];
  EXPECT_EQ(run.start, "truth");
  EXPECT_EQ(run.kind, "wake-up");
  EXPECT_EQ(run.number, 7u);
  ASSERT_EQ(run.events.size(), 2u);
  EXPECT_TRUE(run.events[0].isRight);
  EXPECT_EQ(run.events[0].after, 2.5);
  EXPECT_EQ(run.events[0].readings, 9.0);
  EXPECT_FALSE(run.events[1].isRight);
  EXPECT_TRUE(std::isnan(run.events[1].after));
  EXPECT_TRUE(std::isnan(run.events[1].readings));
}

TEST_F(RunFile, RunsAreInTheOrderOfTheFile) {
  const auto runs = read("{\"runs\": [" + runWith(R"(, "start": "one")") + "," +
                         runWith(R"(, "start": "two")") + "]}");
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].start, "one");
  EXPECT_EQ(runs[1].start, "two");
  EXPECT_TRUE(read("{\"runs\": []}").empty());
}

TEST_F(RunFile, ErrorsSayRunEventAndKind) {
  const std::string two = "{\"runs\": [" + runWith("") + ",";
  EXPECT_EQ(refusal(two + R"({"source": "a", "robot": 3}]})"),
            ": run 2: 'robot' is number, expected text");
  EXPECT_EQ(refusal(two + runWith(R"(, "case": {"kind": "kidnap", "number": 1, "events": [
                {"right": true, "after_s": 1, "after_readings": 1},
                {"right": 1}]})") +
                    "]}"),
            ": run 2, case, event 2: 'right' is number, expected true or false");
  EXPECT_EQ(refusal(runWith(R"(, "case": {"kind": "kidnap", "number": 1, "events": [
                {"right": true, "after_s": "x"}]})")),
            ", case, event 1: 'after_s' is string, expected a number or null");
  EXPECT_EQ(refusal(runWith(R"(, "case": {"kind": "kidnap", "number": 1.5})")),
            ", case: 'number' is number, expected a whole number");
  EXPECT_EQ(refusal(runWith(R"(, "case": {"kind": "kidnap", "number": 1, "events": {}})")),
            ", case: 'events' is object, expected a list");
  EXPECT_EQ(refusal(runWith(R"(, "start": 5)")), ": 'start' is number, expected text");
  EXPECT_EQ(refusal(runWith(R"(, "faults": "all")")), ": 'faults' is string, expected a list");
  EXPECT_EQ(refusal(R"({"source": "a", "robot": "b"})"),
            ": has no key 'seed', as `ortung eval --json` writes it");
}

}  // namespace
}  // namespace ortung::app

// Readings and poses on their way between machines, and parts that nobody has made honestly.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Files.hpp"
#include "NoiseParts.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

class NoisePartsTest : public testing::Test {
 protected:
  static PartHead head(std::uint64_t number, std::uint64_t count) {
    return {kNoiseParts, "{}", {number, count}};
  }
  fs::path part(std::uint64_t number, std::uint64_t count, const NoisePart& content) {
    // Each has a name of its own, since parts name the files that this process has read.
    const fs::path file = folder_ / (std::to_string(files_++) + ".part");
    write(content, head(number, count), file);
    return file;
  }
  /// What one source's arrays say, each of which may be wrong.
  struct Forged {
    std::string list = R"([{"source": 0, "features": ["a/b/c"]}])";
    std::vector<double> stamps = {1, 2};
    std::vector<double> poses = {0, 0, 0, 1, 1, 1};
    std::vector<double> times = {1, 2};
    std::vector<std::int32_t> counts = {1, 2};
    std::vector<std::int32_t> words = {7, 8, 9};
  };
  std::string whyNot(const Forged& forged) {
    const fs::path file = folder_ / (std::to_string(files_++) + ".part");
    PartWriter out(file, head(1, 1));
    addLongText(out.content(), "logs", forged.list);
    const auto add = [&](const char* name, const auto& values) {
      out.content().add(name, {values.size()}, std::span(values));
    };
    add("0.stamps", forged.stamps);
    out.content().add("0.poses", {forged.poses.size() / 3, 3}, std::span(forged.poses));
    add("0.0.stamps", forged.times);
    add("0.0.counts", forged.counts);
    add("0.0.words", forged.words);
    out.commit();
    try {
      mergeNoiseLogs(PartSet({file}));
    } catch (const PartError& error) {
      return error.what();
    } catch (const TableError& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
  int files_ = 0;
};

NoiseLog logOf(Timestamp begin, std::uint32_t word) {
  NoiseLog log;
  log.reference = {{begin, {1.0 / 3.0, -2.0, 3.0}}, {begin + 5, {0.5, 0.25, -3.0}}};
  log.readings["one/LRF/scan"] = {
      {begin + 1, {word, 0xFFFFFFFFu}}, {begin + 1, {}}, {begin + 7, {word}}};
  log.readings["two/Sonar/ring"] = {};
  return log;
}

TEST_F(NoisePartsTest, KeepEachBitAndTheOrderOfTheSources) {
  const NoisePart odd = {{0, logOf(10, 0)}, {2, logOf(4'000'000'000'000, 2)}};
  const NoisePart even = {{1, logOf(-20, 0x80000001u)}};
  const std::vector<NoiseLog> logs = mergeNoiseLogs(PartSet({part(2, 2, even), part(1, 2, odd)}));
  ASSERT_EQ(logs.size(), 3u);
  const NoiseLog* const expected[] = {&odd[0].second, &even[0].second, &odd[1].second};
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(logs[i].reference.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(logs[i].reference[k].first, expected[i]->reference[k].first);
      EXPECT_EQ(logs[i].reference[k].second.x, expected[i]->reference[k].second.x);
      EXPECT_EQ(logs[i].reference[k].second.y, expected[i]->reference[k].second.y);
      EXPECT_EQ(logs[i].reference[k].second.theta, expected[i]->reference[k].second.theta);
    }
    ASSERT_EQ(logs[i].readings.size(), 2u);
    for (const auto& [name, readings] : expected[i]->readings) {
      const auto& found = logs[i].readings.at(name);
      ASSERT_EQ(found.size(), readings.size());
      for (std::size_t k = 0; k < readings.size(); ++k) {
        EXPECT_EQ(found[k].stamp, readings[k].stamp);
        EXPECT_EQ(found[k].words, readings[k].words);
      }
    }
  }
}

TEST_F(NoisePartsTest, NameASourceThatIsOfAnotherShardOrInNone) {
  const auto why = [&](const NoisePart& content, const NoisePart& other) -> std::string {
    try {
      mergeNoiseLogs(PartSet({part(1, 2, content), part(2, 2, other)}));
    } catch (const PartError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why({{0, logOf(1, 1)}}, {{1, logOf(1, 1)}}), "");
  EXPECT_EQ(why({{1, logOf(1, 1)}}, {}), "part 1/2 has source 1, expected 0");
  EXPECT_EQ(why({{0, logOf(1, 1)}}, {{3, logOf(1, 1)}}), "part 2/2 has source 3, expected 1");
  EXPECT_EQ(why({}, {{1, logOf(1, 1)}}), "source 0 is in no part");
}

TEST_F(NoisePartsTest, RefuseArraysThatDoNotFit) {
  const auto expectRefused = [&](const Forged& forged, const std::string& reason) {
    EXPECT_NE(whyNot(forged).find(reason), std::string::npos) << whyNot(forged);
  };
  EXPECT_EQ(whyNot({}), "");
  expectRefused({.list = "{"}, "does not say what it has");
  expectRefused({.list = "[7]"}, "does not say what it has");
  expectRefused({.list = R"([{"source": -1, "features": []}])"}, "has source");
  expectRefused({.list = R"([{"source": 0, "features": ["a", "b"]}])"}, "0.1.stamps");
  expectRefused({.stamps = {2, 1}}, "has 1 as a stamp");
  expectRefused({.stamps = {1, 1.5}}, "has 1.5 as a stamp");
  expectRefused({.stamps = {1, 1e17}}, "as a stamp");
  expectRefused({.stamps = {1, std::nan("")}}, "has nan as a stamp");
  expectRefused({.stamps = {1}}, "0.poses");
  expectRefused({.poses = {0, 0, 0, 1, std::numeric_limits<double>::infinity(), 1}},
                "has a pose that is no number");
  expectRefused({.times = {2, 1}}, "has 1 as a stamp");
  expectRefused({.counts = {1}}, "0.0.counts");
  expectRefused({.counts = {1, -1}}, "fewer words");
  expectRefused({.counts = {1, 3}}, "fewer words");
}

}  // namespace
}  // namespace ortung::app

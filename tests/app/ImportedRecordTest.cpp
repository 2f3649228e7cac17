// What `ortung import` says of what it has written, and sources that it can't write.
#include <map>

#include "Workspace.hpp"
#include "ortung/records/RecordSource.hpp"

namespace ortung::test {
namespace {

class ImportedRecord : public Workspace {
 protected:
  Outcome import(const std::vector<std::string>& more) const {
    std::vector<std::string> command = {"import"};
    command.insert(command.end(), more.begin(), more.end());
    command.insert(command.end(), {"--out", path("out.rec")});
    return ortung(command);
  }
};

TEST_F(ImportedRecord, TheSummaryCountsTheReadingsOfEachFeature) {
  write("run.rec",
        "# ortung record 1\n-500000 m/t/a 1 7\n0 m/t/b 0\n0 m/t/a 1 8\n1250000 m/t/a 1 9\n");
  const Outcome outcome = import({"record", path("run.rec")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.out, path("out.rec") +
                             ": 4 readings over 1.750 s\n"
                             "  m/t/a                                                    3\n"
                             "  m/t/b                                                    1\n");
}

TEST_F(ImportedRecord, TheSummaryNamesTheOtherFiles) {
  const Outcome outcome =
      import({"sim", path("hall.toml"), "--option", "duration=1", "--with-robot",
              path("robot.toml"), "--robot-file", path("mine.toml")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  RecordSource source(path("out.rec"));
  std::map<std::string, std::size_t> counts;
  std::size_t all = 0;
  for (Message message; source.next(message); ++all) ++counts[toText(message.id)];
  EXPECT_TRUE(outcome.out.starts_with(path("out.rec") + ": " + std::to_string(all) + " readings"))
      << outcome.out;
  EXPECT_TRUE(outcome.out.ends_with("\n" + path("mine.toml") + ": robot\n")) << outcome.out;
  ASSERT_EQ(counts.size(), 3u);
  for (const auto& [feature, count] : counts) {
    const std::size_t at = outcome.out.find("\n  " + feature + " ");
    ASSERT_NE(at, std::string::npos) << feature;
    EXPECT_EQ(std::stoul(outcome.out.substr(at + 3 + feature.size())), count) << feature;
  }
}

TEST_F(ImportedRecord, ASourceWithoutReadingsOrWithoutARobotWritesNothing) {
  write("run.rec", "# ortung record 1\n");
  expectRefused(import({"record", path("run.rec")}), 1,
                "ortung import: record:" + path("run.rec") + ": has no reading", {});
  write("run.rec", "# ortung record 1\n0 m/t/a 1 7\n");
  expectRefused(import({"record", path("run.rec"), "--robot-file", path("mine.toml")}), 1,
                "ortung import: record:" + path("run.rec") + ": does not describe its robot",
                {"write " + path("mine.toml") + " by hand"});
  EXPECT_EQ(files(), (std::vector<std::string>{"hall.toml", "robot.toml", "run.rec"}));
}

TEST_F(ImportedRecord, OptionsHaveAKeyAndAValue) {
  expectRefused(import({"record", path("run.rec"), "--option", "=5"}), 2,
                "ortung import: --option is '=5', expected key=value", {});
  expectRefused(import({"record", path("run.rec"), "--robot", "3", "--option", "robot=4"}), 2,
                "ortung import: the option 'robot' is given twice", {});
}

}  // namespace
}  // namespace ortung::test

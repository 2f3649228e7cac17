#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

/// eval on a recorded run with faults.
class EvalFaults : public Workspace {
 protected:
  EvalFaults() {
    learnTables();
    recordRun();
  }
  Outcome eval(const std::string& record, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "eval",     "--source",         "record:" + path(record), "--robot", path("robot.toml"),
        "--tables", path("hall.ortung")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }
};

TEST_F(EvalFaults, AreRecordedNamedAndRepeatable) {
  const Outcome outcome = eval(
      "run.rec", {"--start", "truth", "--fault", "odometry=jump:0.5,0,30@5", "--fault",
                  "readings=crowd@8-12", "--record", path("bad.txt"), "--json", path("a.json")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("  with odometry=jump:0.5,0,30@5\n  with readings=crowd@8-12\n"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(read("bad.txt"), read("run.rec"));
  // The record holds the readings as MCL saw them.
  ASSERT_EQ(eval("bad.txt", {"--start", "truth", "--json", path("b.json")}).exitCode, 0);
  const auto a = nlohmann::json::parse(read("a.json"));
  const auto b = nlohmann::json::parse(read("b.json"));
  EXPECT_EQ(a["faults"].size(), 2u);
  EXPECT_EQ(a["faults"][1], "readings=crowd@8-12");
  EXPECT_EQ(a["position_rmse_m"], b["position_rmse_m"]);
  EXPECT_EQ(a["nees_mean"], b["nees_mean"]);
}

TEST_F(EvalFaults, OneThatMetNoReadingIsSaid) {
  const Outcome outcome = eval("run.rec", {"--start", "truth", "--fault", "odometry=slip@500-510"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("warning: the fault 'odometry=slip@500-510' met no reading"),
            std::string::npos)
      << outcome.err;
}

TEST_F(EvalFaults, WrongOnesAreWrongUsage) {
  expectRefused(eval("run.rec", {"--fault", "odometry=fly"}), 2, "ortung eval: --fault: fault ",
                {"'odometry=fly'", "expected one of missing, frozen, drop:SHARE"});
  expectRefused(eval("run.rec", {"--fault", "sonar/sonar/ring=missing"}), 2,
                "ortung eval: --fault: fault ", {"its features are"});
}

}  // namespace
}  // namespace ortung::test

// What goes wrong with robots, constructed in recordings of real ones: a crowd, a scanner that
// hangs, falls silent or has another clock, wheels that slip or count backwards, no wheels at all.
#include <algorithm>
#include <cstdio>

#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

const std::string kData = ORTUNG_SHARED_DATA;

struct Fault {
  const char* what;
  int runs;
  double lost;     ///< share of the time with an error above 1 m, during the fault, too
  double updates;  ///< the same of the moments with readings: after it, where it leaves none
};

struct FaultyLog {
  const char* name;
  const char* folder;
  const char* options;  ///< of the import, {data} stands for the folder of all
  const char* cell;     ///< [m]
  std::vector<Fault> faults;
};

void PrintTo(const FaultyLog& one, std::ostream* out) { *out << one.name; }  // NOLINT: GoogleTest's

std::string withData(std::string text) {
  for (std::size_t at; (at = text.find("{data}")) != std::string::npos;) text.replace(at, 6, kData);
  return text;
}

class RealFaults : public testing::TestWithParam<FaultyLog> {};

TEST_P(RealFaults, AreOverSoon) {
  const FaultyLog& log = GetParam();
  const std::string path = kData + "/" + log.folder;
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << path << " is not here; it belongs to no repository";
  const Folder folder;
  folder.run({"import", "scanlog", path + withData(log.options), "--out", folder.path("run.rec"),
              "--world", folder.path("world.toml"), "--robot-file", folder.path("robot.toml")});
  folder.run({"learn", "--world", folder.path("world.toml"), "--robot", folder.path("robot.toml"),
              "--out", folder.path("world.ortung"), "--cell", log.cell});
  for (const Fault& fault : log.faults) {
    const auto figures =
        folder.eval({"--source", "record:" + folder.path("run.rec"), "--robot",
                     folder.path("robot.toml"), "--tables", folder.path("world.ortung"), "--start",
                     "truth", "--runs", std::to_string(fault.runs), "--fault", fault.what});
    const auto& runs =
        figures.contains("runs") ? figures["runs"] : nlohmann::json::array({figures});
    ASSERT_EQ(runs.size(), static_cast<std::size_t>(fault.runs)) << fault.what;
    for (const auto& run : runs) {
      EXPECT_LE(run["lost_share"].get<double>(), fault.lost)
          << fault.what << ", seed " << run["seed"];
      EXPECT_LE(run["at_corrections"]["lost_share"].get<double>(), fault.updates)
          << fault.what << ", seed " << run["seed"];
      EXPECT_FALSE(run["converged_after_s"].is_null()) << fault.what;
    }
  }
}

constexpr double kNever = 0.002;  ///< measured: 0

// A third above what is measured, the worse of the seeds (over time; at moments with readings).
// Telecom, whose odometry is poor: frozen 0.310; 0.049, missing 0.257; 0.020 (right again 2 s after
// either), slip 0.124; 0.118 (it comes 7 m), reverse 0.027; 0.023. Intel, thinned to a scan in 3.5
// s: crowd 0.020; 0.019 (one of two seeds is elsewhere until 55 s after it), reverse 0.0093; 0.012
// (29 s, ten scans). Jarvis: zero 0.019, until that is known;
// else never.
INSTANTIATE_TEST_SUITE_P(
    RealLog, RealFaults,
    testing::Values(FaultyLog{"Jarvis",
                              "crob_lab_jarvis/complex_path_fast/security",
                              "?map={data}/crob_lab_jarvis/map_security_from_complex.yaml&"
                              "odom={data}/crob_lab_jarvis/complex_path_fast/odom.txt.xz",
                              "0.1",
                              {{"readings=frozen@20-50", 1, kNever, kNever},
                               {"odometry=slip@30-34", 2, kNever, kNever},
                               {"odometry=reverse@30-34", 2, kNever, kNever},
                               {"odometry=none@0-30", 1, kNever, kNever},
                               {"odometry=zero", 2, 0.026, 0.026},
                               {"readings=late:2", 1, kNever, kNever}}},
                    FaultyLog{"Telecom",
                              "mrpt_sena_telecom",
                              "",
                              "0.2",
                              {{"readings=crowd@15-45", 1, kNever, kNever},
                               {"readings=frozen@15-45", 1, 0.41, 0.066},
                               {"readings=missing@15-45", 1, 0.35, 0.027},
                               {"odometry=slip@20-24", 2, 0.165, 0.157},
                               {"odometry=reverse@20-24", 2, 0.036, 0.031}}},
                    FaultyLog{"Intel",
                              "carmen/intel",
                              "",
                              "0.1",
                              {{"readings=crowd@600-630", 2, 0.027, 0.025},
                               {"readings=late:1.5@300-1200", 1, 0.01, 0.01},
                               {"odometry=reverse@600-604", 2, 0.013, 0.016},
                               {"odometry=zero", 1, 0.004, 0.004}}}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace ortung::test

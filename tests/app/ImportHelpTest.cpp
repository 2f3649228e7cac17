#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "Files.hpp"
#include "KnownKeys.hpp"
#include "Workspace.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/core/SourceHelp.hpp"

namespace ortung::test {
namespace {

using Keys = std::set<std::string>;

constexpr const char* kScans =
    "# t odom n r; ANGLES -1.5 0.5 ; sensor at x=0.780 y=-0.100 yaw=0.500, max range 80.0\n"
    "1.0 0.0 0.0 0.0 3 1.25 0 81.91\n2.0 0.5 0.0 0.1 3 1.5 2 -1\n";

/// Small logs of each kind, opened with an option that nobody knows: the error names all that are.
class ImportHelp : public Workspace {
 protected:
  Keys asked(const std::string& kind, const std::string& path, const std::string& robot) const {
    PluginFactory factory(PluginFactory::standardFolders());
    Parameters options(kind);
    options.set("path", path);
    options.set("robot_file", robot);
    options.set("nobody_knows_this", "1");
    const auto error = messageOf<ConfigError>([&] { factory.make<Source>(kind, options); });
    Keys keys = keysKnownIn(error, "nobody_knows_this");
    keys.erase("path");
    keys.erase("robot_file");
    return keys;
  }
  static Keys told(const std::string& kind) {
    PluginFactory factory(PluginFactory::standardFolders());
    Keys keys;
    const auto help = factory.make<SourceHelp>(kind, Parameters());
    for (const SourceOption& option : help->options()) {
      EXPECT_FALSE(option.meaning.empty() || option.fallback.empty()) << option.key;
      keys.insert(option.key);
    }
    return keys;
  }
};

TEST_F(ImportHelp, NamesTheOptionsThatTheSourceAsksFor) {
  write("Barcodes.dat", "1 5\n6 63\n");
  write("Landmark_Groundtruth.dat", "6 1.0 2.0 0.001 0.001\n");
  write("Robot1_Odometry.dat", "10.0 1.0 0.5\n11.0 0.5 0.0\n");
  write("Robot1_Measurement.dat", "10.5 63 2.0 0.5\n");
  write("scans.txt", kScans);
  write("a.log",
        "PARAM robot_frontlaser_offset 0.1 nohost 0\nODOM 1 0 0 0 0 0 0.9 h 0.9\n"
        "FLASER 2 1.5 2 1.1 0 0 1 0 0 1.0 h 1.0\n");
  EXPECT_EQ(told("mrclam"), asked("mrclam", folder_.string(), ""));
  EXPECT_EQ(told("scanlog"), asked("scanlog", folder_.string(), ""));
  EXPECT_EQ(told("carmen"), asked("carmen", path("a.log"), ""));
  Keys sim = asked("sim", path("hall.toml"), path("robot.toml"));
  sim.insert("robot");  // of scenes alone
  EXPECT_EQ(told("sim"), sim);
}

TEST_F(ImportHelp, OfAKindHasItsOptionsAndWithoutOneItNamesTheKinds) {
  const Outcome one = ortung({"import", "mrclam", "--help"});
  EXPECT_EQ(one.exitCode, 0) << one.err;
  for (const char* part : {"folder of a run", "latency_s [s]", "default: list", "Example:"})
    EXPECT_NE(one.out.find(part), std::string::npos) << part << one.out;
  EXPECT_EQ(one.out.find("laser_yaw_deg"), std::string::npos) << one.out;
  const Outcome all = ortung({"import", "--help"});
  EXPECT_EQ(all.exitCode, 0) << all.err;
  for (const char* part : {"  mrclam ", "  scanlog ", "  carmen ", "  rawlog ", "  mcap ", "  bag ",
                           "  sim ", "  tcp "})
    EXPECT_NE(all.out.find(part), std::string::npos) << part << all.out;
  const Outcome none = ortung({"import", "nix", "--help"});
  EXPECT_EQ(none.exitCode, 0) << none.err;
  EXPECT_NE(none.out.find("nix: does not describe its options"), std::string::npos) << none.out;
}

}  // namespace
}  // namespace ortung::test

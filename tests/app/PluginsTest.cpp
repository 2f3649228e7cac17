// `ortung plugins`, and what foreign code may do when it is loaded.
#include <gtest/gtest.h>

#include <filesystem>

#include "Program.hpp"

namespace ortung::test {
namespace {

/// What it prints of the library whose file ends so.
std::string linesOf(const std::string& text, const std::string& file) {
  const std::size_t at = text.find(file + ".so\n");
  if (at == text.npos) return "(not listed)";
  const std::size_t begin = at + file.size() + 4;
  std::size_t end = begin;
  while (text.compare(end, 2, "  ") == 0) end = text.find('\n', end) + 1;
  return text.substr(begin, end - begin);
}

TEST(Plugins, ThoseThatCrashExitOrTalkWhenLoadedAreNamedAndTheOthersListed) {
  const Outcome outcome = ortung({"plugins"}, {"ORTUNG_PLUGIN_PATH=" TEST_ON_LOAD});
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  const std::string crashes = linesOf(outcome.out, "ortung_a_crashes");
  EXPECT_NE(crashes.find("was ended by signal 11 (Segmentation fault)"), std::string::npos)
      << crashes;
  EXPECT_EQ(linesOf(outcome.out, "ortung_b_exits"), "  BROKEN: ended the process that loaded it\n");
  const std::string aborts = linesOf(outcome.out, "ortung_c_aborts");
  EXPECT_NE(aborts.find("was ended by signal 6 (Aborted)"), std::string::npos) << aborts;
  const std::string talks = linesOf(outcome.out, "ortung_d_talks");
  EXPECT_NE(talks.find("library on_load, version"), std::string::npos) << talks;
  EXPECT_NE(talks.find("SensorData   on_load"), std::string::npos) << talks;
  const std::string scanner = linesOf(outcome.out, "ortung_lrf_data");
  EXPECT_NE(scanner.find("SensorData   lrf"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("hello"), std::string::npos) << outcome.out;
}

TEST(Plugins, PlayersSayWhatTheyDoAndWhatTheirOptionsAre) {
  const Outcome outcome = ortung({"plugins"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::string wander = linesOf(outcome.out, "ortung_wander_player");
  EXPECT_NE(wander.find("  Player       wander\n    drives endlessly to random places"),
            std::string::npos)
      << wander;
  EXPECT_NE(wander.find("\n    speed_m_s [m/s]: how fast it drives at most; default: as fast"),
            std::string::npos)
      << wander;
}

TEST(Plugins, OfAKindSayWhatTheyAreAndWhereTheyAreOnlyIfAsked) {
  for (const char* kind : {"sensor", "motion", "drive", "device", "referee"}) {
    const Outcome outcome = ortung({"plugins", kind});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    for (const char* part : {"SensorData", "MotionModel", "Drive", "Device", "Referee", ".so"})
      EXPECT_EQ(outcome.out.find(part), std::string::npos) << outcome.out;
  }
  EXPECT_NE(ortung({"plugins", "sensor"}).out.find("  distances by a laser"), std::string::npos);
  const Outcome places = ortung({"plugins", "sensor", "--paths"});
  EXPECT_NE(places.out.find("Sensor, SensorData; ortung_lrf_data.so, ortung_lrf_sensor.so\n"),
            std::string::npos)
      << places.out;
  const Outcome own = ortung({"plugins", "sensor"}, {"ORTUNG_PLUGIN_PATH=" TEST_ON_LOAD});
  EXPECT_NE(own.out.find("on_load            SensorData\n"), std::string::npos) << own.out;
}

TEST(Plugins, OneThatNeverFinishesIsGivenUp) {
  const Outcome outcome =
      ortung({"plugins", "--timeout", "0.2"}, {"ORTUNG_PLUGIN_PATH=" TEST_ON_LOAD "/loops"});
  EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
  EXPECT_EQ(linesOf(outcome.out, "ortung_loops"), "  BROKEN: was not loaded within 0.2 s\n");
}

}  // namespace
}  // namespace ortung::test

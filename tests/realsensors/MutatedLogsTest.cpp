/// Damaged logs are read or refused with a sentence; nothing else happens. Seeds are fixed.

#include "LogTesting.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

constexpr int kRounds = 400;

/// Readings must be whole words of known features in the order of time, errors must name the
/// folder.
void expectReadOrRefused(const std::string& source, const std::string& folder, int& read) {
  try {
    Timestamp last = INT64_MIN;
    for (const Message& message : readAll(source)) {
      ASSERT_LE(last, message.stamp);
      ASSERT_FALSE(message.id.model.empty());
      last = message.stamp;
    }
    ++read;
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(folder), std::string::npos) << text;
    EXPECT_LT(text.size(), 1000u);
    // How UndefinedBehaviorSanitizer ends a helper (CMakePresets.json), whose messages nobody
    // reads.
    EXPECT_EQ(text.find("ended with status 77"), std::string::npos) << text;
  }
}

struct Log {
  std::string kind;
  std::string path;  ///< in the folder
  std::map<std::string, std::string> files;
};

Log mrclam() {
  return {"mrclam",
          "",
          {{"Barcodes.dat", "1 5\n6 63\n7 81\n"},
           {"Landmark_Groundtruth.dat", "6 1 2 0 0\n7 3 -1 0 0\n"},
           {"Robot1_Odometry.dat", "10 1 1.5\n11 0.5 0\n12 0 0\n"},
           {"Robot1_Measurement.dat", "10.5 5 1 0.1\n10.5 63 2 0.5\n11.5 81 1.25 3\n"},
           {"Robot1_SparseGroundtruth.dat", "11.1 11 11.5 1 2 0 3\n11.8 11.8 11.8 1.5 2 0 3\n"}}};
}

Log scanlog() {
  return {"scanlog",
          "?reflectors=reflectors.txt&reflector_map=reflector_map.txt",
          {{"scans.txt",
            "# ANGLES -1.5 0.5 ; sensor at x=0.78 y=0 yaw=0, max range 80.0\n"
            "1 0 0 0 3 1.25 0 81.91\n2 0.5 0 0.1 3 1.5 2 1\n3 1 0 0.1 3 1 2 1\n"},
           {"reflectors.txt", "1 2.5 0.5\n1 3 -1\n2 3.5 0\n"},
           {"reflector_map.txt", "1 2 3\n2 -1 4\n"},
           {"gt.txt", "1 4 -5 3\n2 4.5 -5 3.1 0.99\n3 5 -5 3\n"},
           {"map.yaml", "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n"}}};
}

Log carmen() {
  return {"carmen",
          "a.log",
          {{"a.log",
            "PARAM robot_frontlaser_offset 0.1 h 0\nODOM 0 0 0 0 0 0 0.5 h 0.5\n"
            "FLASER 2 1 1 0.9 0 1.5 0.9 0 1.5 1 h 1\nODOM 0.9 0 1.5 0 0 0 0 h 0\nNEFF 15\n"
            "ODOM 0.9 0.5 1.5 0 0 0 2 h 2\nFLASER 2 2 2 0.8 0.4 1.5 0.8 0.4 1.5 2 h 2\n"}}};
}

Log plaza() {
  return {"plaza",
          "",
          {{"plaza1_TL.txt", "5.0 -17.5 59\n6.0 22 23.5\n"},
           {"plaza1_DR.txt", "1 0 0\n2 0.5 0\n3 0 1.5\n"},
           {"plaza1_TD.txt", "2.5 2.0 6.0 20.25\n1.5 2 5 10\n"},
           {"plaza1_GT.txt", "# add 3.1 to heading\n1 2 3 0\n"}}};
}

Log uwbpose() {
  return {
      "uwbpose",
      "",
      {{"README_source.md",
        "| Tag 0 | -0.5 | 0.25 | 0 |\n| Anchor 0 | -3 | 3 | 1.5 |\n| Anchor 1 | 3 | -3 | 1.2 |\n"},
       {"mid_ranges.txt", "1 4 4.5\n1.5 nan 4.5\n"},
       {"mid_gt.txt", "1 0 0 0.96 3.14\n1.5 0 0.2 0.96 3.14\n"}}};
}

Log roh() {
  return {"roh",
          "(X1.5,Y3.0).csv",
          {{"(X1.5,Y3.0).csv", "152,-122.5\n-19 , 0.25\n"}, {"landmark.csv", "0, 0\r\n6, 0\r\n"}}};
}

Log lego() {
  return {"lego",
          "r",
          {{"robot_arena_landmarks.txt", "L C 1000 500 55\nL C 0 -500 55\n"},
           {"r_motors.txt", "M 1 10 0 0 0 7\nM 20 20 0 0 0 9\n"},
           {"r_scan.txt", "S 10 3 100 2000 0\nS 30 3 1 2 3\n"},
           {"r_reference.txt", "P 5 100 200\nP 15 150 200\n"}}};
}

TEST(MutatedLogs, AreReadOrRefused) {
  std::mt19937 random(20240607);
  for (const Log& log : {mrclam(), scanlog(), carmen(), plaza(), uwbpose(), roh(), lego()}) {
    int read = 0;
    for (int round = 0; round < kRounds; ++round) {
      const TemporaryFolder folder;
      std::size_t victim = random() % log.files.size();
      for (const auto& [name, bytes] : log.files) {
        folder.write(name, victim-- == 0 ? mutated(bytes, random) : bytes);
      }
      expectReadOrRefused(log.kind + ":" + (folder.path() / log.path).string(),
                          folder.path().string(), read);
      if (::testing::Test::HasFailure()) FAIL() << log.kind << " round " << round;
    }
    std::printf("%s: %d of %d damaged logs could be read\n", log.kind.c_str(), read, kRounds);
    EXPECT_GT(read, 0);
    EXPECT_LT(read, kRounds);
  }
}

TEST(MutatedLogs, CompressedOnesAreReadOrRefused) {
  std::mt19937 random(7);
  std::string text = "# ANGLES -1.5 0.5\n";
  for (int i = 1; i < 200; ++i)
    text += std::to_string(i) + " 0 0 0 3 " + std::to_string(i * 37 % 11) + " 2 3\n";
  for (const std::string ending : {".xz", ".gz"}) {
    const std::string whole = ending == ".xz" ? compressedXz(text) : compressedGz(text);
    int read = 0;
    for (int round = 0; round < kRounds; ++round) {
      const TemporaryFolder folder;
      folder.write("scans.txt" + ending, mutated(whole, random));
      expectReadOrRefused("scanlog:" + folder.path().string(), folder.path().string(), read);
    }
    EXPECT_LT(read, kRounds / 10)
        << ending;  // both have checksums; some header bytes do not matter
  }
}

TEST(MutatedLogs, RawlogsAreReadOrRefused) {
  if (!errorOf([] { findHelper("ortung-mrpt-reader", ""); }).empty())
    GTEST_SKIP() << "ortung-mrpt-reader was not built";
  ORTUNG_NEED_DATA(data, "mrpt_localization_demo/raw/localization_demo.rawlog");
  // The bytes below the compression, or its checksum would catch everything.
  const TemporaryFolder folder;
  std::filesystem::copy_file(data, folder.path() / "whole.gz");
  std::mt19937 random(11);
  const std::string bytes = readLogBytes(folder.path() / "whole.gz");
  int read = 0;
  for (int round = 0; round < 20; ++round) {
    const auto path = folder.write("a.rawlog", mutated(bytes, random)).string();
    expectReadOrRefused("rawlog:" + path, path, read);
  }
  std::printf("rawlog: %d of 20 damaged logs could be read\n", read);
}

}  // namespace
}  // namespace ortung

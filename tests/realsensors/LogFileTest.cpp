#include "LogTesting.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

std::vector<std::string> linesOf(const std::filesystem::path& path) {
  LogFile file(path);
  std::vector<std::string> lines;
  while (file.nextRecord()) lines.emplace_back(file.line());
  return lines;
}

TEST(LogFile, FindsThePlainFileThenTheCompressedOnes) {
  const TemporaryFolder folder;
  folder.write("a.txt.gz", compressedGz("packed\n"));
  EXPECT_EQ(linesOf(folder.path() / "a.txt"), std::vector<std::string>{"packed"});
  folder.write("a.txt.xz", compressedXz("smaller\n"));
  EXPECT_EQ(linesOf(folder.path() / "a.txt"), std::vector<std::string>{"smaller"});
  folder.write("a.txt", "plain\n");
  EXPECT_EQ(linesOf(folder.path() / "a.txt"), std::vector<std::string>{"plain"});
  EXPECT_EQ(linesOf(folder.path() / "a.txt.gz"), std::vector<std::string>{"packed"});
  const auto missing = (folder.path() / "b.txt").string();
  EXPECT_EQ(
      errorOf([&] { LogFile file(missing); }),
      missing +
          ": found no such file, nor one with .xz or .gz behind its name, expected one of them");
}

TEST(LogFile, LeavesOutCommentsAndEmptyLinesButCountsThem) {
  const TemporaryFolder folder;
  LogFile file(folder.write("a", "# head\n\n  % more\n 1 two\t3 \r\n\n4"));
  ASSERT_TRUE(file.nextRecord());
  EXPECT_EQ(file.lineNumber(), 4u);
  ASSERT_EQ(file.size(), 3u);
  EXPECT_EQ(file.text(1), "two");
  EXPECT_EQ(file.number(2, "n"), 3.0);
  ASSERT_TRUE(file.nextRecord());
  EXPECT_EQ(file.lineNumber(), 6u);
  EXPECT_FALSE(file.nextRecord());
  EXPECT_FALSE(file.nextRecord());
}

TEST(LogFile, TakesOnlyWholeFiniteNumbers) {
  EXPECT_EQ(parseNumber("+1.5e2"), 150.0);
  EXPECT_EQ(parseNumber("-.5"), -0.5);
  for (const char* text :
       {"", "+", "+-1", "nan", "inf", "-inf", "1e999", "1x", "0x10", "1,5", " 1", "1 "}) {
    EXPECT_EQ(parseNumber(text), std::nullopt) << "'" << text << "'";
  }
}

TEST(LogFile, NamesPlaceFoundAndExpectedInErrors) {
  const TemporaryFolder folder;
  const auto path = folder.write("a", "1 nan 2.5 300\n7 8").string();
  LogFile file(path);
  ASSERT_TRUE(file.nextRecord());
  EXPECT_EQ(errorOf([&] { file.number(1, "a range [m]"); }),
            path + ":1: found 'nan' in field 2, expected a range [m], a number");
  EXPECT_EQ(errorOf([&] { file.number(3, "a range [m]", {0, 90}); }),
            path + ":1: found '300' in field 4, expected a range [m], a number in [0, 90]");
  EXPECT_EQ(errorOf([&] { file.integer(2, "a count", {0, 90}); }),
            path + ":1: found '2.5' in field 3, expected a count, a whole number in [0, 90]");
  EXPECT_EQ(errorOf([&] { file.number(9, "a range [m]"); }),
            path + ":1: found 4 fields, expected a range [m], a number");
  ASSERT_TRUE(file.nextRecord());
  EXPECT_EQ(errorOf([&] { file.needFields(3, "x, y, theta"); }),
            path + ":2: found 2 fields, expected 3: x, y, theta (the file ends within this line)");
}

TEST(LogFile, EscapesWhatNobodyCanPrint) {
  EXPECT_EQ(inQuotes("a\x1b[2J\xff"), "'a\\x1b[2J\\xff'");
  EXPECT_EQ(inQuotes(std::string(41, 'a')), "'" + std::string(40, 'a') + "'...");
}

TEST(LogFile, RefusesLinesAndFilesBeyondTheirLimits) {
  const TemporaryFolder folder;
  const auto longLine =
      folder.write("long", "1\n" + std::string(kMaxLogLine + 1, '2') + "\n").string();
  EXPECT_EQ(errorOf([&] { linesOf(longLine); }),
            longLine + ":2: found a line of more than 1048576 bytes, expected a shorter one");
  EXPECT_EQ(linesOf(folder.write("fits", std::string(kMaxLogLine, '2'))).size(), 1u);

  const auto bomb = folder.write("bomb.gz", compressedGz(std::string(1 << 20, '\n'))).string();
  EXPECT_EQ(errorOf([&] {
              LogFile file(bomb, 1000);
              file.nextLine();
            }),
            bomb + ": found more than 1000 bytes (decompressed), expected no more");
}

TEST(LogFile, SaysWhereCompressedFilesAreCutOffOrDamaged) {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += std::to_string(i * 7919 % 10007) + "\n";
  for (const std::string ending : {".xz", ".gz"}) {
    const TemporaryFolder folder;
    const std::string whole = ending == ".xz" ? compressedXz(text) : compressedGz(text);
    const auto path = (folder.path() / ("a" + ending)).string();
    for (const std::size_t kept :
         {std::size_t{0}, std::size_t{5}, whole.size() / 2, whole.size() - 1}) {
      folder.write("a" + ending, whole.substr(0, kept));
      const std::string error = errorOf([&] { linesOf(path); });
      EXPECT_TRUE(
          error.starts_with(path + ": found damaged or truncated data after decompressed byte "))
          << ending << " " << kept << ": " << error;
    }
    std::string broken = whole;
    broken[whole.size() / 2] = static_cast<char>(broken[whole.size() / 2] ^ 0x55);
    folder.write("a" + ending, broken);
    EXPECT_NE(errorOf([&] { linesOf(path); }), "") << ending;
    folder.write("a" + ending, whole);
    EXPECT_EQ(linesOf(path).size(), 20000u);
  }
}

TEST(LogClock, KeepsStampsRisingAndRefusesGreatStepsBack) {
  const TemporaryFolder folder;
  const auto path = folder.write("a", "1\n").string();
  LogFile file(path);
  ASSERT_TRUE(file.nextRecord());
  LogClock clock(0.5);
  EXPECT_EQ(clock(file, 1000000), 1000000);
  EXPECT_EQ(clock(file, 1000000), 1000001);
  EXPECT_EQ(clock(file, 700000), 1000002);
  EXPECT_EQ(clock(file, 2000000), 2000000);
  EXPECT_EQ(errorOf([&] { clock(file, 1400000); }),
            path +
                ":1: found time 1.4 s after 2 s, expected time to run forwards, or back by at most"
                " jitter_s=0.5 s");
}

TEST(AlongArc, FollowsTheCircle) {
  const double pi = 3.14159265358979323846;
  const Pose2 quarter = alongArc({1, 2, pi / 2}, 1.0, pi / 2, 1.0);  // radius 2 / pi, to the left
  EXPECT_NEAR(quarter.x, 1 - 2 / pi, 1e-12);
  EXPECT_NEAR(quarter.y, 2 + 2 / pi, 1e-12);
  EXPECT_NEAR(quarter.theta, pi, 1e-12);
  const Pose2 straight = alongArc({0, 0, 0}, 0.5, 0.0, 2.0);
  EXPECT_DOUBLE_EQ(straight.x, 1.0);
  EXPECT_DOUBLE_EQ(straight.y, 0.0);
  for (const double w : {1e-12, 1e-9, 3e-9, 1e-6}) {  // series of sin and cos; no loss of digits
    const Pose2 nearly = alongArc({0, 0, 0}, 1.0, w, 1.0);
    EXPECT_NEAR(nearly.x, 1.0 - w * w / 6, 1e-15);
    EXPECT_NEAR(nearly.y, w / 2, 1e-15);
  }
}

TEST(Toml, WritesNumbersAsFloatsAndEscapesText) {
  EXPECT_EQ(tomlNumber(1), "1.0");
  EXPECT_EQ(tomlNumber(-0.125), "-0.125");
  EXPECT_EQ(tomlNumber(1e-7), "0.0000001");
  EXPECT_EQ(tomlText("a\"b\\c\n"), "\"a\\\"b\\\\c\\u000a\"");
}

}  // namespace
}  // namespace ortung

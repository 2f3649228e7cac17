/// Numbers and texts of foreign logs, for any bytes and any numbers.

#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>

#include "LogTesting.hpp"
#include "Seeded.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

/// What the C library reads, if the text has no other characters than those of decimal numbers.
std::optional<double> byTheLibrary(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789.+-eE") != std::string::npos)
    return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

RC_GTEST_PROP(LogNumbers, AreThoseThatTheCLibraryReads, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::elementOf(std::string("0159.+-eE")));
  const auto expected = byTheLibrary(text);
  const auto found = parseNumber(text);
  // The library calls a number below the least one 0 or subnormal; both say that it is tiny.
  if (expected && std::abs(*expected) < 1e-300 && !found) return;
  RC_ASSERT(found == expected);
}

RC_GTEST_PROP(LogNumbers, AreReadAsTheyWereWrittenInToml, (double value)) {
  RC_PRE(std::isfinite(value));
  const std::string text = tomlNumber(value);
  RC_ASSERT(parseNumber(text) == value);
  RC_ASSERT(text.find('.') != std::string::npos);                          // TOML: a float
  RC_ASSERT(text.find_first_not_of("-0123456789.") == std::string::npos);  // without an exponent
}

/// What a text of TOML means: the characters between its quotes, with escapes undone.
std::string meaningOf(const std::string& toml) {
  std::string text;
  for (std::size_t i = 1; i + 1 < toml.size(); ++i) {
    const bool isEscaped = toml[i] == '\\';
    if (isEscaped) ++i;
    if (isEscaped && toml[i] == 'u') {
      text += static_cast<char>(std::stoi(toml.substr(i + 1, 4), nullptr, 16));
      i += 4;
    } else {
      text += toml[i];
    }
  }
  return text;
}

RC_GTEST_PROP(TomlTexts, MeanTheBytesTheyWereMadeOf, (const std::string& bytes)) {
  const std::string toml = tomlText(bytes);
  RC_ASSERT(toml.front() == '"' && toml.back() == '"');
  for (const char c : toml) RC_ASSERT(static_cast<unsigned char>(c) >= 32 && c != 127);
  RC_ASSERT(meaningOf(toml) == bytes);
}

RC_GTEST_PROP(QuotedTexts, ArePrintableAndShort, (const std::string& bytes)) {
  const std::string text = inQuotes(bytes);
  for (const char c : text) RC_ASSERT(c >= 32 && c < 127);
  RC_ASSERT(text.size() <= 4u * 40 + 5);
  RC_ASSERT(text.ends_with("'...") == (bytes.size() > 40));
}

/// One line of a file at a time.
class LogFields : public ::testing::Test {
 protected:
  /// The file at its first record.
  std::unique_ptr<LogFile> at(const std::string& line) {
    auto file = std::make_unique<LogFile>(folder_.write("a", line + "\n"));
    EXPECT_TRUE(file->nextRecord());
    return file;
  }
  std::unique_ptr<LogFile> commas(const std::string& line) {
    auto file = std::make_unique<LogFile>(folder_.write("a.csv", line + "\n"), LogFile::kCommas);
    EXPECT_TRUE(file->nextRecord());
    return file;
  }
  /// What an error expects.
  static std::string expected(const std::function<void()>& action) {
    const std::string error = errorOf(action);
    const std::size_t begin = error.find(", expected ");
    return begin == error.npos ? error : error.substr(begin + 11);
  }
  TemporaryFolder folder_;
};

TEST_F(LogFields, AreSplitAtCommasWithAndWithoutBlanks) {
  const auto file = commas("1, 2 ,\t3 4\t,,5, \r");
  ASSERT_EQ(file->size(), 6u);
  EXPECT_EQ(file->text(0), "1");
  EXPECT_EQ(file->text(1), "2");
  EXPECT_EQ(file->text(2), "3 4");
  EXPECT_EQ(file->text(3), "");
  EXPECT_EQ(file->text(4), "5");
  EXPECT_EQ(file->text(5), "");
  EXPECT_EQ(file->text(6), "") << "beyond the last one";
  EXPECT_EQ(file->number(4, "n"), 5.0);
  EXPECT_EQ(errorOf([&] { file->number(3, "n"); }),
            file->place() + ": found '' in field 4, expected n, a number");
}

TEST_F(LogFields, ALineOfBlanksHasNoneWhateverSeparatesThem) {
  LogFile file(folder_.write("b.csv", " \t\n \r\n7\n"), LogFile::kCommas);
  ASSERT_TRUE(file.nextRecord());
  EXPECT_EQ(file.lineNumber(), 3u);
  EXPECT_EQ(file.size(), 1u);
}

TEST_F(LogFields, RangesIncludeBothOfTheirEnds) {
  const auto file = at("-2 3 2.999 3.001");
  EXPECT_EQ(file->number(0, "n", {-2, 3}), -2.0);
  EXPECT_EQ(file->number(1, "n", {-2, 3}), 3.0);
  EXPECT_EQ(expected([&] { file->number(3, "n", {-2, 3}); }), "n, a number in [-2, 3]");
  EXPECT_EQ(expected([&] { file->number(0, "n", {.low = 0.5}); }), "n, a number of at least 0.5");
  EXPECT_EQ(expected([&] { file->number(1, "n", {.high = 2.5}); }), "n, a number of at most 2.5");
  EXPECT_EQ(file->number(2, "n", {.high = 3}), 2.999);
}

// Beyond 9 * 10^15 doubles skip whole numbers.
TEST_F(LogFields, WholeNumbersAreExact) {
  const auto file = at("9e15 -9e15 9.1e15 -9.1e15 1.5 -0");
  EXPECT_EQ(file->integer(0, "n", {}), 9'000'000'000'000'000);
  EXPECT_EQ(file->integer(1, "n", {}), -9'000'000'000'000'000);
  EXPECT_EQ(file->integer(5, "n", {}), 0);
  for (const std::size_t field : {2, 3, 4})
    EXPECT_EQ(expected([&] { file->integer(field, "n", {}); }), "n, a whole number") << field;
}

TEST_F(LogFields, StampsAreSecondsRoundedToMicroseconds) {
  const auto file = at("1.0000004 1.0000006 -0.25 1e10 -1e10 10000000001");
  EXPECT_EQ(file->stamp(0), 1'000'000);
  EXPECT_EQ(file->stamp(1), 1'000'001);
  EXPECT_EQ(file->stamp(2), -250'000);
  EXPECT_EQ(file->stamp(3), 10'000'000'000'000'000);
  EXPECT_EQ(file->stamp(4), -10'000'000'000'000'000);
  EXPECT_EQ(expected([&] { file->stamp(5); }),
            "a time [s], a number in [-10000000000, 10000000000]");
}

TEST_F(LogFields, PosesHaveTheirAnglesWrapped) {
  const auto file = at("0 1.5 -2.5 6.5 1000000 -1000001 0");
  const Pose2 pose = file->pose(1);
  EXPECT_EQ(pose.x, 1.5);
  EXPECT_EQ(pose.y, -2.5);
  EXPECT_NEAR(pose.theta, 6.5 - 2 * M_PI, 1e-12);
  EXPECT_EQ(expected([&] { file->pose(4); }), "y [m], a number in [-1000000, 1000000]");
  EXPECT_EQ(expected([&] { file->pose(5); }), "x [m], a number in [-1000000, 1000000]");
  EXPECT_EQ(expected([&] { at("0 0 1000001")->pose(0); }),
            "an angle [rad], a number in [-1000000, 1000000]");
}

// Blocks are of 64 KiB: lines that lie across their ends are whole.
TEST_F(LogFields, LinesAcrossBlocksAreWhole) {
  for (const std::size_t length : {65533U, 65534U, 65535U, 65536U, 65537U, 131072U}) {
    LogFile file(folder_.write("a", std::string(length, 'x') + " end\nnext\n"));
    ASSERT_TRUE(file.nextRecord());
    ASSERT_EQ(file.size(), 2u) << length;
    EXPECT_EQ(file.text(0).size(), length);
    EXPECT_EQ(file.text(1), "end");
    ASSERT_TRUE(file.nextRecord());
    EXPECT_EQ(file.text(0), "next");
    EXPECT_EQ(file.lineNumber(), 2u);
    EXPECT_FALSE(file.nextRecord());
  }
}

TEST_F(LogFields, ReadLogBytesGivesAllBytesUpToItsLimit) {
  std::string bytes(200'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 % 251);
  EXPECT_EQ(readLogBytes(folder_.write("plain", bytes)), bytes);
  const auto packed = folder_.write("packed.xz", compressedXz(bytes));
  EXPECT_EQ(readLogBytes(packed), bytes);
  EXPECT_EQ(readLogBytes(packed, 200'000), bytes);
  EXPECT_EQ(errorOf([&] { readLogBytes(packed, 199'999); }),
            packed.string() + ": found more than 199999 bytes (decompressed), expected no more");
}

}  // namespace
}  // namespace ortung

// Options as commands declare them, and what command lines make of them.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "CommandLine.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

struct Arguments {
  std::string text = "none";
  std::filesystem::path file;
  double number = 2.5;
  std::optional<double> share;
  std::optional<std::uint64_t> count;
  std::vector<std::string> names;
  std::vector<std::string> parts;
  std::vector<std::string> inputs;
  std::string choice = "auto";
  std::string shortcut;
  std::string hidden;
  bool isQuick = false;
  std::vector<std::string> words;
  std::string commandLine;
};

Arguments& newest() {
  static Arguments arguments;
  return arguments;
}

int take(const Arguments& arguments) {
  newest() = arguments;
  return 7;
}

/// Stands for a command of the catalogue.
void declare(Builder& build) {
  const auto a = build.command<Arguments>("check", "ortung check --number 3", take);
  a->commandLine = build.commandLine();
  build.option("inputs", a->inputs, "Files").expects(1, 2);
  build.option("--text", a->text, "Any text").required();
  const std::size_t first = build.options();
  build.option("--number", a->number, "A number").within(-1.5, 10.0).showsDefault();
  build.option("--count", a->count, "A count").within(1, 1000);
  build.flag("--quick", a->isQuick, "Leaves something out");
  build.keepGiven(first, a->words);
  build.option("--name", a->names, "A name").repeats();
  build.option("--share", a->share, "A share").within(0.0, 1.0);
  build.option("--parts", a->parts, "Parts").splitsAt(',').oneOf({"bias", "mount"});
  build.option("--choice", a->choice, "A choice").oneOf({"auto", "truth"}).showsDefault();
  build.option("--inside", a->hidden, "").hides();
  build.shortcut("--short", "Short for --text x",
                 [a](const std::string& value) { a->shortcut = "<" + value + ">"; });
}

struct Parsed {
  int exitCode = -1;  ///< 7: the command ran
  std::string out;
  std::string err;
};

Parsed parse(std::vector<std::string> words) {
  words.insert(words.begin(), {"ortung", "check"});
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  newest() = {};
  const ParsedCommand parsed =
      parseCommandLine({declare}, static_cast<int>(pointers.size()), pointers.data());
  Parsed result;
  result.exitCode = parsed.run ? parsed.run() : parsed.exitCode;
  std::fflush(stdout);
  result.out = testing::internal::GetCapturedStdout();
  result.err = testing::internal::GetCapturedStderr();
  if (parsed.run) {
    EXPECT_EQ(parsed.name, "check");
  }
  return result;
}

void expectRefused(const std::vector<std::string>& more, const std::string& part) {
  std::vector<std::string> words = {"in", "--text", "t"};
  words.insert(words.end(), more.begin(), more.end());
  const Parsed parsed = parse(words);
  EXPECT_EQ(parsed.exitCode, 2) << part;
  EXPECT_TRUE(parsed.err.starts_with("ortung check: ")) << parsed.err;
  EXPECT_TRUE(parsed.err.ends_with("; see `ortung check --help`\n")) << parsed.err;
  EXPECT_NE(parsed.err.find(part), std::string::npos) << parsed.err;
  EXPECT_EQ(std::count(parsed.err.begin(), parsed.err.end(), '\n'), 1) << parsed.err;
  EXPECT_EQ(parsed.out, "");
}

TEST(OptionBuilder, ValuesOfAllTypesAreTaken) {
  const Parsed parsed = parse({"in",      "--text",  "a b",        "--number", "-1.5",  "--share",
                               "1",       "--count", "1000",       "--name",   "x",     "--name",
                               "y,z",     "--parts", "bias,mount", "--choice", "truth", "--quick",
                               "--short", "s",       "--inside",   "i"});
  ASSERT_EQ(parsed.exitCode, 7) << parsed.err;
  const Arguments& a = newest();
  EXPECT_EQ(a.inputs, std::vector<std::string>{"in"});
  EXPECT_EQ(a.text, "a b");
  EXPECT_EQ(a.number, -1.5);
  EXPECT_EQ(a.share, 1.0);
  EXPECT_EQ(a.count, 1000u);
  EXPECT_EQ(a.names, (std::vector<std::string>{"x", "y,z"}));
  EXPECT_EQ(a.parts, (std::vector<std::string>{"bias", "mount"}));
  EXPECT_EQ(a.choice, "truth");
  EXPECT_EQ(a.shortcut, "<s>");
  EXPECT_EQ(a.hidden, "i");
  EXPECT_TRUE(a.isQuick);
}

TEST(OptionBuilder, WhatIsNotGivenKeepsItsDefault) {
  ASSERT_EQ(parse({"in", "--text", "t"}).exitCode, 7);
  const Arguments& a = newest();
  EXPECT_EQ(a.number, 2.5);
  EXPECT_FALSE(a.share);
  EXPECT_FALSE(a.count);
  EXPECT_EQ(a.choice, "auto");
  EXPECT_FALSE(a.isQuick);
  EXPECT_TRUE(a.words.empty());
}

TEST(OptionBuilder, NumbersOutsideOfTheirBoundsAreRefusedWithThem) {
  expectRefused({"--number", "-1.51"}, "--number: is '-1.51', expected a number from -1.5 to 10");
  expectRefused({"--number", "10.001"}, "expected a number from -1.5 to 10");
  for (const char* number : {"nan", "inf", "1e999", "", "3 ", "0x3", "1,5", "+3"})
    expectRefused({"--number", number}, std::string("is '") + number + "', expected a number");
  expectRefused({"--count", "0"}, "is '0', expected a number from 1 to 1000");
  expectRefused({"--count", "1001"}, "is '1001', expected a number from 1 to 1000");
  expectRefused({"--count", "2.5"}, "--count");
}

TEST(OptionBuilder, OtherWordsAndNumbersOfWordsAreRefused) {
  expectRefused({"--choice", "track"}, "track");
  expectRefused({"--parts", "bias,latency"}, "latency");
  expectRefused({"--frobnicate"}, "--frobnicate");
  expectRefused({"b", "c"}, "c");
  EXPECT_EQ(parse({"a", "b", "--text", "t"}).exitCode, 7);
  const Parsed missing = parse({"in"});
  EXPECT_EQ(missing.exitCode, 2);
  EXPECT_EQ(missing.err, "ortung check: --text is required; see `ortung check --help`\n");
}

TEST(OptionBuilder, HelpHasTextsDefaultsAndExampleButNothingHidden) {
  const Parsed parsed = parse({"--help"});
  EXPECT_EQ(parsed.exitCode, 0);
  for (const char* part : {"--number", "A number", "=2.5 ", "--plugin-seconds", "=10 ", "=auto",
                           "Short for --text x", "Example:\n  ortung check --number 3"})
    EXPECT_NE(parsed.out.find(part), std::string::npos) << part << "\n" << parsed.out;
  EXPECT_EQ(parsed.out.find("--inside"), std::string::npos);
  EXPECT_EQ(parsed.err, "");
}

// `eval --view` gives them to `view`, which has these options, too.
TEST(OptionBuilder, WordsOfSomeOptionsAreKeptAsTheyWereGiven) {
  ASSERT_EQ(parse({"in", "--quick", "--text", "t", "--number", "3e0", "--name", "a"}).exitCode, 7);
  EXPECT_EQ(newest().words, (std::vector<std::string>{"--number", "3e0", "--quick"}));
}

// A report says how it was made, in words for a shell.
TEST(OptionBuilder, TheCommandLineIsQuotedWhereAShellNeedsIt) {
  ASSERT_EQ(parse({"sim:a.toml?b=1", "--text", "don't do", "--name", "", "--name", "a_b-./:,=+@%9"})
                .exitCode,
            7);
  EXPECT_EQ(newest().commandLine,
            "ortung check 'sim:a.toml?b=1' --text 'don'\\''t do' --name '' --name a_b-./:,=+@%9");
}

}  // namespace
}  // namespace ortung::app

#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

template <class Action>
std::string complaint(const Action& action) {
  return test::messageOf<ConfigError>(action);
}

std::string complaintOf(const std::string& text, std::size_t most = kMaxConfigBytes) {
  return complaint([&] { parseToml(text, "x.toml", most); });
}

TEST(Toml, BecomesParameters) {
  const Parameters p = parseToml(
      "a = 1\nb = 2.5\nc = 'text'\nd = true\ne = [1, 2.5]\n[t]\npose = { x_m = 0.5 }\n[[s]]\nn = "
      "1\n[[s]]\nn = 2\n",
      "x.toml");
  EXPECT_EQ(p.integer("a"), 1);
  EXPECT_EQ(p.number("b"), 2.5);
  EXPECT_EQ(p.text("c"), "text");
  EXPECT_TRUE(p.flagOr("d", false));
  EXPECT_EQ(p.numbers("e"), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(p.table("t").table("pose").number("x_m"), 0.5);
  ASSERT_EQ(p.tables("s").size(), 2u);
  EXPECT_EQ(p.tables("s")[0].integer("n"), 1);
  EXPECT_EQ(p.tables("s")[1].integer("n"), 2);
  EXPECT_NO_THROW(p.refuseUnread());
}

TEST(Toml, LosesTablesOfArraysThatAreLeftOut) {
  const std::string text =
      "a = 1 # a remark\n[t]\nb = 'x'\n[[s]]\nn = 1\n[[s]]\nn = 2\nq = [[1, 2], [3]]\n[[u]]\nn = "
      "1\n";
  const auto one = [](const std::string&, const Parameters& table) {
    return table.integerOr("n", 0) == 1;
  };
  const Parameters rest = parseToml(withoutTables(text, "x.toml", one), "rest");
  EXPECT_EQ(rest.integer("a"), 1);
  EXPECT_EQ(rest.table("t").text("b"), "x");
  ASSERT_EQ(rest.tables("s").size(), 1U);
  EXPECT_EQ(rest.tables("s")[0].integer("n"), 2);
  EXPECT_FALSE(rest.has("u")) << "nothing is left of it";
  const auto ofU = [](const std::string& key, const Parameters&) { return key == "u"; };
  EXPECT_EQ(parseToml(withoutTables(text, "x.toml", ofU), "rest").tables("s").size(), 2U);
  EXPECT_EQ(complaint([&] { withoutTables("a = 2024-01-02\n", "x.toml", one); }),
            "x.toml:1: dates and times are not used here");
  EXPECT_TRUE(complaint([&] { withoutTables("a = \n", "x.toml", one); }).starts_with("x.toml:1: "));
}

TEST(Toml, ErrorsNameTheLine) {
  const Parameters p =
      parseToml("# one\n[t]\n  fov_deg = 400\n\n[[s]]\nn = 'x'\n", "robots/a.toml");
  EXPECT_EQ(complaint([&] { p.table("t").number("fov_deg", {0, 360}); }),
            "robots/a.toml:3: fov_deg is 400, must be in [0, 360]");
  EXPECT_EQ(complaint([&] { p.tables("s")[0].number("n"); }),
            "robots/a.toml:6: n is a text, expected a number");
  EXPECT_TRUE(complaintOf("a = 1\nb = \n").starts_with("x.toml:2: "))
      << complaintOf("a = 1\nb = \n");
  EXPECT_TRUE(complaintOf("a = 1\na = 2\n").starts_with("x.toml:2: "))
      << complaintOf("a = 1\na = 2\n");
  EXPECT_EQ(complaintOf("a = 1\nd = 2024-01-02\n"), "x.toml:2: dates and times are not used here");
}

TEST(Toml, RefusesWhatIsTooLarge) {
  EXPECT_EQ(complaintOf(std::string(101, '\n'), 100),
            "x.toml: has 101 bytes, at most 100 are read");
  const test::TemporaryFolder folder;
  test::writeBytes(folder / "big.toml", std::string(kMaxConfigBytes + 1, '\n'));
  EXPECT_NE(complaint([&] { readToml(folder / "big.toml"); }).find("at most 8388608 are read"),
            std::string::npos);
  test::writeBytes(folder / "fits.toml", std::string(kMaxConfigBytes, '\n'));
  EXPECT_NO_THROW(readToml(folder / "fits.toml"));
}

TEST(Toml, RefusesMissingFilesAndFolders) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(complaint([&] { readToml(folder / "no.toml"); }),
            (folder / "no.toml").string() + ": can't be read: No such file or directory");
  EXPECT_EQ(complaint([&] { readToml(folder.path()); }),
            folder.path().string() + ": can't be read: Is a directory");
}

std::string repeated(const std::string& part, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += part;
  return all;
}

TEST(Toml, TextOfAFileIsThatOfItsBytes) {
  const test::TemporaryFolder folder;
  const std::string text = "a = 1  # \xC3\xA4\r\n\n";
  test::writeBytes(folder / "a.toml", text);
  EXPECT_EQ(readTomlText(folder / "a.toml"), text);
  EXPECT_EQ(complaint([&] { readTomlText(folder / "no.toml"); }),
            (folder / "no.toml").string() + ": can't be read: No such file or directory");
  test::writeBytes(folder / "big.toml", std::string(kMaxConfigBytes + 1, ' '));
  EXPECT_NE(complaint([&] { readTomlText(folder / "big.toml"); }).find("at most 8388608 are read"),
            std::string::npos);
}

// What can't be read is not taken for the end. (Of this file nothing is at its beginning.)
TEST(Toml, TellsThatReadingFailed) {
  EXPECT_EQ(complaint([&] { readTomlText("/proc/self/mem"); }),
            "/proc/self/mem: can't be read: Input/output error");
}

TEST(Toml, RefusesDeepNestingInAnyForm) {
  const std::vector<std::string> bombs = {
      "a = " + std::string(100000, '['),
      "a = " + repeated("{a=", 100000),
      "a" + repeated(".a", 500000) + " = 1",
      "[a" + repeated(".a", 500000) + "]",
      "1" + repeated(".1", 300000) + " = 1",
      "1.1" + repeated(" . 1.1", 100000) + " = 1",
      "a1" + repeated(".a1", 200000) + " = 1",
      "-1" + repeated(".-1", 200000) + " = 1",
      // texts that end in a quote of their own
      "a = [\"\"\"x\"\"\"\"\", {b" + repeated(".b", 200000) + " = 1}]",
      "a = ['''x'''', {b" + repeated(".b", 200000) + " = 1}]",
      "a = '''\n\"'''\nb" + repeated(".b", 200000) + " = 1",
      "\"=\"" + repeated(".\"=\"", 200000) + " = 1",
      // dotted keys within lists, line by line: each line is harmless
      repeated("a = [\n{b" + repeated(".b", 4000) + " = [\n{", 30),
      "a = [\n" + repeated("{b" + repeated(".b", 4000) + " = [\n", 60),
      // brackets closed in comments and texts only
      "a = " + repeated("[ # ]\n", 10000),
      "a = " + repeated("[ ']', \n", 10000),
  };
  for (const std::string& bomb : bombs) {
    const std::string told = complaintOf(bomb);
    EXPECT_TRUE(told.starts_with("x.toml:")) << told << " for " << bomb.substr(0, 30);
  }
}

TEST(Toml, TakesWhatPeopleWrite) {
  const std::string comments = repeated("# angles in [0, 2 pi), e.g. 3.14. See above.\n", 200);
  EXPECT_NO_THROW(parseToml(comments + "a = 1\n", "x.toml"))
      << "open brackets in comments are no nesting";
  EXPECT_NO_THROW(parseToml("a = [ " + repeated("0.125, -1.5e-3, ", 2500) + "]\n", "x.toml"))
      << "a long list of numbers";
  EXPECT_NO_THROW(parseToml("map = '../../maps/../a.b.c/(1.2.3)[final].png'\n", "x.toml"));
  EXPECT_NO_THROW(
      parseToml(repeated("[[obstacle]]\npose = { x_m = 1.5, y_m = 2.5 }\n", 8000), "x.toml"));
}

// Assertions of the parser's library ended the program here.
TEST(Toml, KeysThatBeginWithNoKeyAreRefused) {
  for (const char* text : {"[=]\n", "[\"a\".=]\n", "[[=]]\n", "=1\n", "a = { = 1 }\n", "a = {,}\n",
                           "a = { b = 1, = 2 }\n", "]\n", "[]\n", "[a\n", "a.=1\n", "a = 1 b\n"})
    EXPECT_THROW(parseToml(text, "x.toml"), ConfigError) << text;
}

// The parser's library took for granted that such letters never stand where white space may.
TEST(Toml, LettersOfOtherAlphabetsBelongIntoQuotes) {
  for (const std::string letter : {"\u00A1", "\u01E8", "\u060F", "\u1681", "\u2010", "\uFEFE"}) {
    EXPECT_THROW(parseToml("a" + letter + " = 1\n", "x.toml"), ConfigError) << letter;
    EXPECT_THROW(parseToml("a = 1" + letter + "\n", "x.toml"), ConfigError) << letter;
    EXPECT_THROW(parseToml("a = [1," + letter + "]\n", "x.toml"), ConfigError) << letter;
    EXPECT_EQ(parseToml("# " + letter + "\na = '" + letter + "' # " + letter, "x.toml").text("a"),
              letter);
  }
}

TEST(Toml, SurvivesMutations) {
  const std::string seed =
      "[robot]\nname = 'a'\n[[sensor]]\nplugin = \"lrf\"\npose = { x_m = 0.1, theta_deg = -90 }\nl "
      "= [1, 2]\n";
  static const std::string kNasty = "[]{}.=\"'#\n,\\0x-+eT:";
  Random random(1);
  int taken = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = seed;
    for (std::uint64_t k = 1 + random.below(3); k > 0 && !text.empty(); --k) {
      const std::size_t at = random.below(text.size());
      switch (random.below(4)) {
        case 0:
          text[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          text.insert(at, 1, kNasty[random.below(kNasty.size())]);
          break;
        case 2:
          text.erase(at, 1 + random.below(6));
          break;
        default:
          text.insert(at, text.substr(random.below(text.size()), random.below(20)));
          break;
      }
    }
    try {
      parseToml(text, "x.toml");
      ++taken;
    } catch (const ConfigError& error) {
      ASSERT_TRUE(std::string(error.what()).starts_with("x.toml:")) << error.what();
    }
  }
  EXPECT_GT(taken, 500);
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <cmath>

#include "Files.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {
namespace {

using Node = Parameters::Node;

template <class Action>
std::string complaint(const Action& action) {
  return test::messageOf<ConfigError>(action);
}

/// As from line 1, 2, ... of the file "x.toml".
Parameters example() {
  Parameters p("x.toml");
  p.set("flag", Node{true, 1});
  p.set("whole", Node{std::int64_t{7}, 2});
  p.set("real", Node{2.5, 3});
  p.set("text", Node{std::string("abc"), 4});
  p.set("list", Node{Parameters::List{Node{1.0, 5}, Node{std::int64_t{2}, 5}}, 5});
  p.set("words", Node{Parameters::List{Node{std::string("a"), 6}, Node{std::string("b"), 6}}, 6});
  Parameters inner("x.toml");
  inner.set("deep", Node{1.0, 8});
  p.set("table", Node{inner, 7});
  p.set("nan", Node{std::nan(""), 9});
  p.set("huge", Node{1e300, 10});
  p.set("tables", Node{Parameters::List{Node{inner, 11}}, 11});
  return p;
}

TEST(Parameters, GivesWhatIsThere) {
  const Parameters p = example();
  EXPECT_TRUE(p.flagOr("flag", false));
  EXPECT_EQ(p.integer("whole"), 7);
  EXPECT_EQ(p.number("whole"), 7.0);
  EXPECT_EQ(p.number("real"), 2.5);
  EXPECT_EQ(p.text("text"), "abc");
  EXPECT_EQ(p.numbers("list", 2), (std::vector<double>{1, 2}));
  EXPECT_EQ(p.texts("words"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(p.table("table").number("deep"), 1.0);
  EXPECT_EQ(p.tables("tables").size(), 1u);
  EXPECT_EQ(p.choiceOr("text", "x", {"x", "abc"}), "abc");
  EXPECT_TRUE(p.has("huge"));
  EXPECT_FALSE(p.has("nothing"));
}

TEST(Parameters, GivesTheFallbackForWhatIsMissing) {
  const Parameters p("x.toml");
  EXPECT_TRUE(p.flagOr("a", true));
  EXPECT_EQ(p.integerOr("a", 3), 3);
  EXPECT_EQ(p.numberOr("a", 1.5), 1.5);
  EXPECT_EQ(p.textOr("a", "b"), "b");
  EXPECT_EQ(p.numbersOr("a", {1}), std::vector<double>{1});
  EXPECT_EQ(p.choiceOr("a", "b", {"b"}), "b");
  EXPECT_TRUE(p.table("a").keys().empty());
  EXPECT_TRUE(p.tables("a").empty());
}

TEST(Parameters, AMissingKeyIsComparedWithThoseThatNobodyAskedFor) {
  Parameters p("w.toml");
  p.set("mass", 5.0);
  p.set("colour", "red");
  EXPECT_EQ(complaint([&] { p.number("mass_kg"); }),
            "w.toml: mass_kg is missing (is 'mass' meant for it?); there are colour, mass");
  EXPECT_EQ(p.number("mass"), 5.0);
  EXPECT_EQ(complaint([&] { p.number("mass_kg"); }),
            "w.toml: mass_kg is missing; there are colour, mass")
      << "a key that is known is no slip";
}

TEST(Parameters, SaysWhereAndWhatIsWrong) {
  const Parameters p = example();
  EXPECT_EQ(
      complaint([&] { p.number("gone"); }),
      "x.toml: gone is missing; there are flag, huge, list, nan, real, table, tables, text, ...");
  EXPECT_EQ(complaint([&] { p.number("text"); }), "x.toml:4: text is a text, expected a number");
  EXPECT_EQ(complaint([&] { p.number("flag", {0, 1}); }),
            "x.toml:1: flag is a flag (true/false), expected a number in [0, 1]");
  EXPECT_EQ(complaint([&] { p.number("real", {3, 4}); }),
            "x.toml:3: real is 2.5, must be in [3, 4]");
  EXPECT_EQ(complaint([&] { p.numberOr("real", 3, {.low = 3}); }),
            "x.toml:3: real is 2.5, must be at least 3");
  EXPECT_EQ(complaint([&] { p.number("real", {.high = 2}); }),
            "x.toml:3: real is 2.5, must be at most 2");
  EXPECT_EQ(complaint([&] { p.number("nan"); }), "x.toml:9: nan is not finite, expected a number");
  EXPECT_EQ(complaint([&] { p.integer("real"); }),
            "x.toml:3: real is 2.5, expected a whole number");
  EXPECT_EQ(complaint([&] { p.integer("huge"); }),
            "x.toml:10: huge is 1e+300, expected a whole number");
  EXPECT_EQ(complaint([&] { p.integerOr("whole", 1, {8, 9}); }),
            "x.toml:2: whole is 7, must be in [8, 9]");
  EXPECT_EQ(complaint([&] { p.text("whole"); }),
            "x.toml:2: whole is a whole number, expected a text");
  EXPECT_EQ(complaint([&] { p.choiceOr("text", "x", {"x", "y"}); }),
            "x.toml:4: text is 'abc', must be one of: x, y");
  EXPECT_EQ(complaint([&] { p.flagOr("real", true); }),
            "x.toml:3: real is a number, expected true or false");
  EXPECT_EQ(complaint([&] { p.numbers("real"); }),
            "x.toml:3: real is a number, expected a list of numbers");
  EXPECT_EQ(complaint([&] { p.numbers("list", 3); }), "x.toml:5: list has 2 entries, expected 3");
  EXPECT_EQ(complaint([&] { p.numbersOr("list", {}, -1, {2, 9}); }),
            "x.toml:5: list is 1, must be in [2, 9]");
  EXPECT_EQ(complaint([&] { p.numbers("words"); }), "x.toml:6: words is a text, expected a number");
  EXPECT_EQ(complaint([&] { p.texts("text"); }),
            "x.toml:4: text is a text, expected a list of texts");
  EXPECT_EQ(complaint([&] { p.texts("list"); }),
            "x.toml:5: list holds a number, expected texts only");
  EXPECT_EQ(complaint([&] { p.table("list"); }),
            "x.toml:5: list is a list, expected a table [list]");
  EXPECT_EQ(complaint([&] { p.tables("table"); }),
            "x.toml:7: table is a table, expected tables [[table]]");
  EXPECT_EQ(complaint([&] { p.tables("words"); }),
            "x.toml:6: words holds a text, expected tables only");
  EXPECT_EQ(complaint([&] { p.fail("real", "smells"); }), "x.toml:3: real smells");
}

TEST(Parameters, WithoutAFileNamesTheKeyAlone) {
  Parameters p;
  p.set("a", 1.0);
  EXPECT_EQ(complaint([&] { p.text("a"); }), "a is a number, expected a text");
}

TEST(Parameters, RefusesWhatNobodyAskedFor) {
  Parameters p("x.toml");
  p.set("beams", Node{1.0, 3});
  p.set("max_rang_m", Node{8.0, 4});
  EXPECT_EQ(complaint([&] { p.refuseUnread(); }), "x.toml:3: beams is not known here");
  p.number("beams");
  p.numberOr("max_range_m", 5.0);
  EXPECT_EQ(complaint([&] { p.refuseUnread(); }),
            "x.toml:4: max_rang_m is not known here (did you mean 'max_range_m'?); known are "
            "beams, max_range_m");
  p.number("max_rang_m");
  EXPECT_NO_THROW(p.refuseUnread());
}

TEST(Parameters, RefusesUnreadKeysOfInnerTables) {
  const Parameters p = example();
  for (const std::string& key : p.keys()) {
    if (key == "table")
      p.table(key);
    else if (key == "tables")
      p.tables(key);
    else if (key == "flag")
      p.flagOr(key, true);
    else if (key == "text")
      p.text(key);
    else if (key == "words")
      p.texts(key);
    else if (key == "list")
      p.numbers(key);
    else if (key != "nan")
      p.number(key);
  }
  EXPECT_THROW(p.number("nan"), ConfigError);  // asked for, too
  EXPECT_EQ(complaint([&] { p.refuseUnread(); }), "x.toml:8: deep is not known here");
  p.table("table").number("deep");
  EXPECT_NO_THROW(p.refuseUnread()) << "copies share what was read";
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

using Kind = Question::Kind;

TEST(Questions, AreThoseOfAllGetters) {
  Parameters p("x.toml");
  p.survey();
  p.numberOr("speed", 0.5, {0.0, 2.0});
  p.integerOr("count", 3, {1.0, 9.0});
  p.flagOr("on", true);
  p.choiceOr("look", "net", {"net", "solid"});
  p.numbersOr("size", {1.0, 2.5}, 2, {0.0, 10.0});
  p.table("pose").numberOr("x_m", 0.0);
  EXPECT_TRUE(p.tables("part").empty());
  EXPECT_THROW(p.text("name"), ConfigError);

  const auto all = p.questions();
  EXPECT_EQ(all.at("speed").kind, Kind::kNumber);
  EXPECT_EQ(all.at("speed").range.high, 2.0);
  EXPECT_EQ(all.at("speed").fallback, "0.5");
  EXPECT_EQ(all.at("count").kind, Kind::kInteger);
  EXPECT_EQ(all.at("count").fallback, "3");
  EXPECT_EQ(all.at("on").fallback, "true");
  EXPECT_EQ(all.at("look").choices, (std::vector<std::string>{"net", "solid"}));
  EXPECT_EQ(all.at("look").fallback, "\"net\"");
  EXPECT_EQ(all.at("size").count, 2);
  EXPECT_EQ(all.at("size").fallback, "[1, 2.5]");
  EXPECT_EQ(all.at("part").kind, Kind::kTables);
  EXPECT_EQ(all.at("name").kind, Kind::kText);
  EXPECT_EQ(all.at("name").fallback, std::nullopt);
  // A table that is not there was asked, too.
  ASSERT_EQ(p.askedTables("pose").size(), 1u);
  EXPECT_EQ(p.askedTables("pose").front().questions().at("x_m").kind, Kind::kNumber);
}

TEST(Questions, AreKeptOfTablesThatAreThere) {
  Parameters p = parseToml("[[sensor]]\nplugin = \"a\"\n[[sensor]]\nplugin = \"b\"\n", "x.toml");
  p.survey();
  for (const Parameters& sensor : p.tables("sensor")) sensor.text("plugin");
  const auto asked = p.askedTables("sensor");
  ASSERT_EQ(asked.size(), 2u);
  for (const Parameters& sensor : asked) EXPECT_TRUE(sensor.questions().contains("plugin"));
}

TEST(Questions, AreNotKeptWithoutASurvey) {
  const Parameters p = parseToml("a = 1\n[t]\nb = 2\n", "x.toml");
  p.number("a");
  p.table("t").number("b");
  EXPECT_TRUE(p.questions().empty());
  EXPECT_TRUE(p.askedTables("t").empty());
}

TEST(Questions, ChangeNothingThatIsRead) {
  const char* text = "a = 1\nb = \"x\"\n[t]\nc = [1, 2]\n";
  Parameters surveyed = parseToml(text, "x.toml");
  const Parameters plain = parseToml(text, "x.toml");
  surveyed.survey();
  EXPECT_EQ(surveyed.number("a"), plain.number("a"));
  EXPECT_EQ(surveyed.table("t").numbers("c"), plain.table("t").numbers("c"));
  EXPECT_EQ(test::messageOf<ConfigError>([&] { surveyed.refuseUnread(); }),
            test::messageOf<ConfigError>([&] { plain.refuseUnread(); }));
}

TEST(Questions, AMisspeltKeyIsToldWithTheNearestOne) {
  const Parameters p = parseToml("max_rnage_m = 1\n", "r.toml");
  p.numberOr("max_range_m", 1.0);
  p.numberOr("period_s", 1.0);
  EXPECT_EQ(test::messageOf<ConfigError>([&] { p.refuseUnread(); }),
            "r.toml:1: max_rnage_m is not known here (did you mean 'max_range_m'?); known are "
            "max_range_m, period_s");
}

}  // namespace
}  // namespace ortung

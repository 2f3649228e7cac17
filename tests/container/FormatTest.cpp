#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "AllFormats.hpp"
#include "Files.hpp"
#include "Seeded.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/Format.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/ObstaclesData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/TalkData.hpp"

namespace ortung {
namespace {

using test::messageOf;

std::string word() {
  return *rc::gen::resize(12, rc::gen::nonEmpty(rc::gen::container<std::string>(
                                  rc::gen::elementOf(std::string("abcxyz019_")))));
}

std::string value() {
  return *rc::gen::resize(
      12, rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::inRange<char>(0x21, 0x7F))));
}

RC_GTEST_PROP(FormatText, ReadsBack, ()) {
  Format format(word());
  const int count = *rc::gen::inRange(0, 10);
  for (int i = 0; i < count; ++i)
    if (const std::string key = word(); !format.has(key)) format.with(key, value());
  const std::string text = format.toText();
  RC_ASSERT(parseFormat(text) == format);
  RC_ASSERT(parseFormat(text).toText() == text);
}

RC_GTEST_PROP(FormatText, NumbersAreTheSameAfterwards, (double number)) {
  const Format format = Format("range").with("max_m", number);
  RC_ASSERT(parseFormat(format.toText()).number("max_m") == number);
}

RC_GTEST_PROP(FormatText, AnglesOfShortDegreesStayShort, ()) {
  const int hundredths = *rc::gen::inRange(-36'000, 36'001);
  const Format format = Format("scan").withAngle("first_deg", radians(hundredths / 100.0));
  RC_ASSERT(format.number("first_deg") == hundredths / 100.0);
  RC_ASSERT(format.angle("first_deg") == radians(hundredths / 100.0));
}

RC_GTEST_PROP(FormatText, WhateverComesIsRefusedOrReadsBack, (const std::string& text)) {
  try {
    RC_ASSERT(parseFormat(text).toText() == text);
  } catch (const std::invalid_argument&) {
  }
}

TEST(FormatText, KeepsTheOrderOfItsParameters) {
  const Format format = parseFormat("scan step_deg=1 beams=180");
  EXPECT_EQ(format.name(), "scan");
  ASSERT_EQ(format.parameters().size(), 2u);
  EXPECT_EQ(format.parameters()[1].first, "beams");
  EXPECT_EQ(format.number("beams"), 180.0);
  EXPECT_EQ(format.text("step_deg"), "1");
  EXPECT_EQ(format.toText(), "scan step_deg=1 beams=180");
}

TEST(FormatText, ListsHaveNoBlanks) {
  const std::vector<const char*> names = {"the field is searched", "a, b", "lost"};
  const Format format = Format("track").with("reason", names);
  EXPECT_EQ(format.toText(), "track reason=the_field_is_searched,a__b,lost");
  EXPECT_EQ(format.list("reason"),
            (std::vector<std::string>{"the_field_is_searched", "a__b", "lost"}));
  EXPECT_EQ(parseFormat("x row=,a,").list("row"), (std::vector<std::string>{"", "a", ""}));
}

TEST(FormatText, WhatWouldNotReadBackIsRefused) {
  for (const char* text :
       {"", " ", "Scan", "sc-an", "scan ", " scan", "scan  beams=1", "scan beams",
        "scan beams=", "scan =1", "scan Beams=1", "scan beams=1 beams=1", "scan\tbeams=1",
        "scan beams=\x7F", "scan beams=\xC3\xA4", "scan\n"})
    EXPECT_THROW(parseFormat(text), std::invalid_argument) << text;
  EXPECT_THROW(parseFormat(std::string_view("a\0b", 3)), std::invalid_argument);
  EXPECT_NE(messageOf<std::invalid_argument>([] { parseFormat("scan beams"); }).find("'beams'"),
            std::string::npos);
  EXPECT_THROW(Format("a b"), std::invalid_argument);
  EXPECT_THROW(Format(std::string(65, 'a')), std::invalid_argument);
  EXPECT_NO_THROW(Format(std::string(64, 'a')));
  EXPECT_THROW(Format("a").with("b", std::string("c d")), std::invalid_argument);
  EXPECT_THROW(Format("a").with("b", std::numeric_limits<double>::quiet_NaN()),
               std::invalid_argument);
  EXPECT_THROW(Format("a").withAngle("b", std::numeric_limits<double>::infinity()),
               std::invalid_argument);
}

TEST(FormatText, LengthsAreLimited) {
  std::string text = "a";
  for (int i = 0; i < 32; ++i) text += " k" + std::to_string(i) + "=1";
  EXPECT_EQ(parseFormat(text).parameters().size(), 32u);
  EXPECT_THROW(parseFormat(text + " more=1"), std::invalid_argument);
  EXPECT_EQ(parseFormat("a b=" + std::string(896, 'x')).toText().size(), 900u);
  EXPECT_THROW(parseFormat("a b=" + std::string(897, 'x')), std::invalid_argument);
  EXPECT_THROW(Format("a").with("b", std::string(897, 'x')), std::invalid_argument);
}

TEST(FormatText, WhatIsMissingIsTold) {
  const Format format = parseFormat("cone max_m=far");
  EXPECT_FALSE(format.has("beams"));
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { format.text("beams"); }),
            "the format 'cone' has no parameter 'beams'");
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { format.number("max_m"); }),
            "the format 'cone' has no number 'max_m'");
  for (const char* number : {"inf", "nan", "1x", "0x10", "1e999", ",", "+1"}) {
    const Format one = Format("cone").with("max_m", std::string(number));
    EXPECT_THROW(one.number("max_m"), std::invalid_argument) << number;
  }
}

/// Programs on both ends of a wire know these lines: they stay as they are.
TEST(FormatLines, AreThoseOfTheirFirstDay) {
  const SensorId id{"M", "T", "F"};
  EXPECT_EQ(ScalarData(id, {}, {}).format().toText(), "range max_m=20");
  EXPECT_EQ(BearingData(id, {}, {}).format().toText(), "bearing");
  EXPECT_EQ(ConeData(id, {}, {.openingAngle = radians(25.0), .maxRange = 3.5}).format().toText(),
            "cone opening_deg=25 max_m=3.5");
  EXPECT_EQ(
      ScanData(
          id, {},
          {.beams = 180, .firstAngle = radians(-90.0), .angleStep = radians(1.0), .maxRange = 8.0})
          .format()
          .toText(),
      "scan beams=180 first_deg=-90 step_deg=1 max_m=8");
  EXPECT_EQ(LandmarksData(id, {}, {.identities = {1}, .range = {}}).format().toText(), "landmarks");
  EXPECT_EQ(PointsData(id, {}, {}).format().toText(), "points");
  EXPECT_EQ(PoseFixData(id, {}).format().toText(), "fix");
  EXPECT_EQ(PoseData(id).format().toText(), "pose");
  EXPECT_EQ(OdometryData(id).format().toText(), "odometry");
  EXPECT_EQ(ObjectsData(id).format().toText(), "objects");
  EXPECT_EQ(ObstaclesData(id).format().toText(), "obstacles");
  EXPECT_EQ(TalkData(id).format().toText(), "talk");
  EXPECT_EQ(PlacesData(id).format().toText(), "places");
}

}  // namespace
}  // namespace ortung

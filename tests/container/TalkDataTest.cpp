// What robots tell each other, as words and as texts.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>

#include "ortung/base/Angles.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/TalkData.hpp"

namespace ortung {
namespace {

using Words = std::vector<std::uint32_t>;
const SensorId kId{"radio", "teammate", "talk"};

std::string printableText(std::size_t longest) {
  const auto characters = *rc::gen::container<std::vector<int>>(rc::gen::inRange(32, 127));
  std::string text(characters.begin(), characters.end());
  text.resize(std::min(text.size(), longest));
  return text;
}

Place placeAt(double x, double y, double theta) {
  return {Place::Kind::kRobot,
          "blue-1",
          {{x, y, theta}, {0.04, 0.01, 0.002, 0.01, 0.09, 0.003, 0.002, 0.003, 0.01}}};
}

TEST(TalkData, IsLengthsAndFourBytesAWord) {
  const Words words = TalkData::encode({"anna", {{0.01, "b", "hello"}}});
  EXPECT_EQ(words, (Words{4, 0x616e6e61, 10'000, 1, 'b', 5, 0x6c6c6568, 'o'}));
}

RC_GTEST_PROP(TalkData, KeepsWhatWasSaid, ()) {
  TalkData::Reading said{printableText(TalkData::kLongestName), {}};
  const int count = *rc::gen::inRange(0, 20);
  for (int i = 0; i < count; ++i)
    said.messages.push_back({*rc::gen::inRange(0, 4'000'000) * 1e-3,
                             printableText(TalkData::kLongestName),
                             printableText(TalkData::kLongestText)});
  TalkData data(kId);
  data.setData(1, TalkData::encode(said));
  RC_ASSERT(data.reading().listener == said.listener);
  RC_ASSERT(data.reading().messages.size() == said.messages.size());
  for (std::size_t i = 0; i < said.messages.size(); ++i) {
    RC_ASSERT(data.reading().messages[i].from == said.messages[i].from);
    RC_ASSERT(data.reading().messages[i].text == said.messages[i].text);
    RC_ASSERT(std::abs(data.reading().messages[i].age - said.messages[i].age) < 1e-6);
  }
}

/// Whatever a network sends is taken as it is or refused; what was taken gives the same words.
RC_GTEST_PROP(TalkData, AnyWordsAreTakenOrRefused, (const Words& tail, bool startsWell)) {
  Words words = startsWell ? Words{1, 'a', 5, 1, 'b'} : Words{};
  for (const std::uint32_t word : tail) words.push_back(word % 3 == 0 ? word : word % 7);
  TalkData data(kId);
  try {
    data.setData(1, words);
  } catch (const std::invalid_argument&) {
    RC_ASSERT(data.sequence() == 0U);
    return;
  }
  if (!words.empty()) RC_ASSERT(TalkData::encode(data.reading()) == words);
}

void expectRefused(const Words& words, const std::string& why) {
  TalkData data(kId);
  try {
    data.setData(1, words);
    FAIL() << "taken, expected: " << why;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(TalkData, RefusesWhatIsNoTalk) {
  expectRefused({65, 0}, "a listener of 65 characters, expected at most 64");
  expectRefused({4}, "found 0 words where 1 were expected");
  expectRefused({1, 'a', 0}, "found 0 words where 1 were expected");
  expectRefused({1, 'a', 0, 1, 'b', 401}, "a message of 401 characters, expected at most 400");
  expectRefused({1, '\n'}, "a listener that is not printable ASCII");
  expectRefused({1, 0x6261}, "whose last word is not filled up with 0");
  EXPECT_THROW(TalkData::encode({"anna", {{0.0, "b", "\x7f"}}}), std::invalid_argument);
  EXPECT_THROW(TalkData::encode({"anna", std::vector<TalkData::Message>(1001)}),
               std::invalid_argument);
}

TEST(PlacesData, KeepsPlaces) {
  Place ball = placeAt(-1.0, 2.0, 0.0);
  ball.kind = Place::Kind::kBall;
  ball.name = "ball";
  ball.fix.covariance[8] = Place::kNoHeading * Place::kNoHeading;
  ball.fix.covariance[2] = ball.fix.covariance[6] = 0.0;
  PlacesData data(kId);
  data.setData(1,
               PlacesData::encode({{placeAt(1.5, -0.25, 1.0), 0.25, "anna"}, {ball, 0.0, "bert"}}));
  ASSERT_EQ(data.reading().size(), 2u);
  const PlacesData::Told& robot = data.reading()[0];
  EXPECT_EQ(robot.place.name, "blue-1");
  EXPECT_EQ(robot.from, "anna");
  EXPECT_DOUBLE_EQ(robot.age, 0.25);
  EXPECT_NEAR(robot.place.fix.pose.x, 1.5, 1e-9);
  EXPECT_NEAR(robot.place.fix.covariance[1], 0.01, 1e-5);
  EXPECT_TRUE(robot.place.hasHeading());
  EXPECT_EQ(data.reading()[1].place.kind, Place::Kind::kBall);
  EXPECT_FALSE(data.reading()[1].place.hasHeading());
  EXPECT_THROW(data.setData(2, Words{2}), std::invalid_argument);
  EXPECT_THROW(data.setData(2, Words{0, 0}), std::invalid_argument);
  Place nameless = ball;
  nameless.name = "a b";
  EXPECT_THROW(PlacesData::encode({{nameless, 0.0, "bert"}}), std::invalid_argument);
}

TEST(PlaceText, SaysWhereSomethingIs) {
  Place place = placeAt(1.5, -0.25, 1.0);
  const std::string text = toText(place);
  EXPECT_EQ(text, "robot blue-1 1.500 -0.250 57.30 0.2000 0.3000 5.730 0.167 0.100 0.100");
  const std::optional<Place> read = placeIn(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, "blue-1");
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(read->fix.covariance[i], place.fix.covariance[i], 1e-4) << i;
  place.fix.covariance[8] = 1e4;
  EXPECT_EQ(toText(place), "robot blue-1 1.500 -0.250 - 0.2000 0.3000 - 0.167 0.000 0.000");
  ASSERT_TRUE(placeIn(toText(place)));
  EXPECT_FALSE(placeIn(toText(place))->hasHeading());
}

TEST(PlaceText, LeavesOtherTextsAlone) {
  for (const char* text : {"", "robot", "robot a", "hello team", "robot a 1 2 3 0.1 0.1 1 0 0",
                           "robot a 1 2 3 0.1 0.1 1 0 0 0 0", "robot a nan 2 3 0.1 0.1 1 0 0 0",
                           "robot a 1 2 3 -0.1 0.1 1 0 0 0", "robot a 1 2 3 0.1 0.1 1 2 0 0",
                           "robot a/b 1 2 3 0.1 0.1 1 0 0 0", "robot a - 2 3 0.1 0.1 1 0 0 0",
                           "crate a 1 2 3 0.1 0.1 1 0 0 0", "robot a 1e300 2 3 0.1 0.1 1 0 0 0"})
    EXPECT_FALSE(placeIn(text)) << text;
  EXPECT_TRUE(placeIn("robot a 1 2 3 0.1 0.1 1 0 0 0"));
  EXPECT_THROW(toText(placeAt(NAN, 0.0, 0.0)), std::invalid_argument);
}

TEST(PlaceText, EachOfItsNumbersHasItsLimits) {
  constexpr double kFarthest = 1e5;  // [m]
  const double noHeading = degrees(Place::kNoHeading);
  struct Limit {
    double least, most;
  };
  const std::vector<Limit> limits = {{-kFarthest, kFarthest},
                                     {-kFarthest, kFarthest},
                                     {-1e300, 1e300},
                                     {0.0, kFarthest},
                                     {0.0, kFarthest},
                                     {0.0, noHeading},
                                     {-1.0, 1.0},
                                     {-1.0, 1.0},
                                     {-1.0, 1.0}};
  const std::vector<double> usual = {1.0, 2.0, 3.0, 0.1, 0.1, 1.0, 0.0, 0.0, 0.0};
  const auto isPlace = [&](std::size_t number, double value) {
    std::ostringstream text;
    text << "robot a" << std::setprecision(17);
    for (std::size_t i = 0; i < usual.size(); ++i) text << ' ' << (i == number ? value : usual[i]);
    return placeIn(text.str()).has_value();
  };
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const auto [least, most] = limits[i];
    const double beyond = 0.001 * most;
    EXPECT_TRUE(isPlace(i, 0.999 * most)) << i;
    EXPECT_TRUE(isPlace(i, 0.999 * least)) << i;
    if (most >= 1e300) continue;  // any angle
    EXPECT_FALSE(isPlace(i, most + beyond)) << i;
    EXPECT_FALSE(isPlace(i, least - beyond)) << i;
  }
}

/// Texts of strangers do no harm, and what is a place can be said again.
RC_GTEST_PROP(PlaceText, AnyTextIsAPlaceOrNot, ()) {
  static const std::vector<std::string> kWords = {"robot", "ball", "a", "-",  "1", "-0.5",
                                                  "1e9",   "nan",  "0", "90", ""};
  std::string text = *rc::gen::element<std::string>("robot", "ball", "x");
  const int count = *rc::gen::inRange(8, 13);
  for (int i = 0; i < count; ++i) text += " " + *rc::gen::elementOf(kWords);
  if (const std::optional<Place> place = placeIn(text))
    RC_ASSERT(placeIn(toText(*place)).has_value());
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "Files.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

using test::messageOf;

SensorData& addPose(SensorContainer& container, const SensorId& id) {
  return container.add(std::make_unique<PoseData>(id));
}

/// Twelve features: models A B, types t u, features 1 2 3.
void fill(SensorContainer& container) {
  for (const std::string model : {"A", "B"}) {
    for (const std::string type : {"t", "u"}) {
      for (const std::string feature : {"1", "2", "3"}) addPose(container, {model, type, feature});
    }
  }
}

TEST(SensorContainer, FindsByAnySubsetOfTheThreeNames) {
  SensorContainer container;
  fill(container);
  for (const std::string_view model : {"", "*", "A", "B", "C"}) {
    for (const std::string_view type : {"", "*", "t", "u", "v"}) {
      for (const std::string_view feature : {"", "*", "1", "2", "3", "4"}) {
        std::vector<const SensorData*> expected;
        for (const auto& data : container.all()) {
          const auto fits = [](std::string_view wanted, const std::string& name) {
            return wanted.empty() || wanted == "*" || wanted == name;
          };
          const SensorId& id = data->id();
          if (fits(model, id.model) && fits(type, id.type) && fits(feature, id.feature))
            expected.push_back(data.get());
        }
        const SensorQuery query{model, type, feature};
        const auto found = container.findAll(query);
        EXPECT_EQ(std::vector<const SensorData*>(found.begin(), found.end()), expected);
        EXPECT_EQ(container.find(query), expected.empty() ? nullptr : expected.front());
      }
    }
  }
}

TEST(SensorContainer, FindsExactlyOne) {
  SensorContainer container;
  fill(container);
  ASSERT_NE(container.findExactly({"B", "u", "2"}), nullptr);
  EXPECT_EQ(toText(container.findExactly({"B", "u", "2"})->id()), "B/u/2");
  EXPECT_EQ(container.findExactly({"B", "u", ""}), nullptr);
}

TEST(SensorContainer, RefusesASecondFeatureOfOneName) {
  SensorContainer container;
  addPose(container, {"A", "b", "c"});
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { addPose(container, {"A", "b", "c"}); }),
            "feature already in the container: A/b/c; give one of the two another model, type or "
            "feature");
  EXPECT_EQ(container.all().size(), 1u);
}

TEST(SensorQuery, IsReadFromText) {
  const SensorQuery query = parseSensorQuery("LMS200/*/");
  EXPECT_EQ(query.model, "LMS200");
  EXPECT_EQ(query.type, "*");
  EXPECT_EQ(query.feature, "");
  const SensorQuery between = parseSensorQuery("LMS200//scan");
  EXPECT_EQ(between.model, "LMS200");
  EXPECT_EQ(between.type, "");
  EXPECT_EQ(between.feature, "scan");
  for (const char* text : {"", "a", "a/b", "a/b/c/d"}) {
    EXPECT_EQ(messageOf<std::invalid_argument>([&] { parseSensorQuery(text); }),
              std::string("'") + text + "' is not model/type/feature (each may be *)");
  }
}

TEST(SensorContainer, GivesTypedReadingsAndNothingForOtherTypesOrNoReading) {
  SensorContainer container;
  container.add(std::make_unique<ScalarData>(SensorId{"cam", "camera", "post1Distance"}, Pose2{},
                                             ScalarData::Config{}));
  EXPECT_FALSE(container.get<ScalarData>({.type = "camera"}).has_value())
      << "there was no reading yet";
  EXPECT_TRUE(container.set({5, {"cam", "camera", "post1Distance"}, {1500}}));
  EXPECT_DOUBLE_EQ(container.get<ScalarData>({.feature = "post1Distance"})->value(), 1.5);
  EXPECT_FALSE(container.get<PoseData>({.type = "camera"}).has_value()) << "it is no pose";
  EXPECT_FALSE(container.get<ScalarData>({.type = "LRF"}).has_value());
}

TEST(SensorContainer, CountsMessagesOfFeaturesItDoesNotHave) {
  SensorContainer container;
  fill(container);
  const std::vector<std::uint32_t> words = PoseData::encode({});
  EXPECT_FALSE(container.set({1, {"C", "t", "1"}, words}));
  const std::vector<Message> frame = {
      {1, {"A", "t", "1"}, words}, {1, {"C", "t", "1"}, words}, {1, {"A", "t", "9"}, words}};
  EXPECT_EQ(container.set(frame), 2u);
  EXPECT_EQ(container.findExactly({"A", "t", "1"})->sequence(), 1u);
}

TEST(SensorContainer, NamesTheFeatureWhoseWordsItRefuses) {
  SensorContainer container;
  fill(container);
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { container.set({1, {"A", "t", "1"}, {1}}); }),
            "A/t/1: found 1 words, expected 3");
}

TEST(SensorContainer, TakesAFrameWholeOrNotAtAll) {
  SensorContainer container;
  fill(container);
  const auto frame = [](Timestamp stamp, std::uint32_t word, std::vector<std::uint32_t> last) {
    return std::vector<Message>{{stamp, {"A", "t", "1"}, {word, word, 0}},
                                {stamp, {"C", "t", "1"}, {word}},
                                {stamp, {"B", "u", "3"}, {word, word, 0}},
                                {stamp, {"A", "t", "2"}, std::move(last)}};
  };
  EXPECT_EQ(container.set(frame(1, 10, {10, 10, 0})), 1u);
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { container.set(frame(2, 20, {20, 20, 36000})); }),
            "A/t/2: found the angle word 36000, expected below 36000");
  for (const SensorId& id : {SensorId{"A", "t", "1"}, {"B", "u", "3"}, {"A", "t", "2"}}) {
    const SensorData& data = *container.findExactly(id);
    EXPECT_EQ(data.stamp(), 1) << toText(id);
    EXPECT_EQ(data.sequence(), 1u) << toText(id);
    EXPECT_EQ(data.getData()[0], 10u) << toText(id);
    EXPECT_EQ(static_cast<const PoseData&>(data).reading().x, words::toSignedMetres(10));
  }
  EXPECT_EQ(container.set(frame(3, 30, {30, 30, 0})), 1u) << "the next frame is taken";
  EXPECT_EQ(container.findExactly({"A", "t", "2"})->stamp(), 3);
}

TEST(SensorContainer, HasNoExpectationWithoutLearnedFeatures) {
  SensorContainer container;
  EXPECT_EQ(container.getProbability(Pose2{}), kNoExpectation);
  fill(container);
  EXPECT_EQ(container.getProbability(Pose2{}), kNoExpectation);
}

// Every frame writes one number into all words of all features; a reader that sees two different
// numbers has seen a torn frame.
TEST(SensorContainer, ReadersNeverSeeATornFrame) {
  SensorContainer container;
  fill(container);
  constexpr std::uint32_t kFrames = 3000;
  const auto write = [&container](std::uint32_t first) {
    std::vector<Message> frame;
    for (const auto& data : container.all()) frame.push_back({0, data->id(), {}});
    for (std::uint32_t n = 1; n <= kFrames; ++n) {
      for (Message& message : frame) {
        message.stamp = first + n;
        message.words.assign(3, first + n);
      }
      container.set(frame);
    }
  };
  std::atomic<bool> done = false;
  std::atomic<int> torn = 0;
  std::atomic<long> looks = 0;
  const auto look = [&] {
    do {
      const auto lock = container.read();
      const SensorData& reference = *container.all().front();
      for (const auto& data : container.all()) {
        if (data->stamp() != reference.stamp() || data->sequence() != reference.sequence()) ++torn;
        for (const std::uint32_t word : data->getData())
          torn += static_cast<Timestamp>(word) != reference.stamp();
      }
      ++looks;
    } while (!done);
  };
  {
    std::vector<std::jthread> readers;
    for (int i = 0; i < 2; ++i) readers.emplace_back(look);
    {
      std::jthread other(write, 10000u);
      write(0);
    }
    done = true;
  }
  EXPECT_EQ(torn, 0);
  EXPECT_GT(looks, 0);
  EXPECT_EQ(container.all().front()->sequence(), 2 * kFrames);
}

}  // namespace
}  // namespace ortung

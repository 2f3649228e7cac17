#include <gtest/gtest.h>

#include "FakeHost.hpp"
#include "Output.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/BinaryReading.hpp"

namespace ortung::server {
namespace {

std::shared_ptr<const Message> picture(std::size_t words) {
  Message message{17, {"camera", "image", "front"}, {}};
  for (std::size_t i = 0; i < words; ++i)
    message.words.push_back(static_cast<std::uint32_t>(i * 2654435761U));
  return std::make_shared<const Message>(std::move(message));
}

/// Takes bytes off in pieces of @p most.
std::string drain(Output& output, std::size_t most) {
  std::string all;
  while (!output.isEmpty()) {
    std::vector<std::string_view> pieces;
    output.look(most, pieces);
    std::size_t count = 0;
    for (const std::string_view piece : pieces) {
      all += piece;
      count += piece.size();
    }
    EXPECT_LE(count, most);
    output.take(count);
  }
  return all;
}

TEST(Output, IsTheBytesInTheirOrderHoweverTheyAreTaken) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    Output output;
    std::string expected;
    std::string taken;
    for (int i = 0; i < 20; ++i) {
      if (random.below(3) == 0) {
        const auto reading = picture(random.below(300));
        writeBinary(*reading, expected);
        output.add(reading);
      } else {
        const std::string text(random.below(40), static_cast<char>('a' + i));
        expected += text;
        output.add(text);
      }
      // What is looked at stays where it is while more comes.
      std::vector<std::string_view> pieces;
      output.look(1 + random.below(500), pieces);
      std::string seen;
      for (const std::string_view piece : pieces) seen += piece;
      output.add("more");
      expected += "more";
      std::string again;
      for (const std::string_view piece : pieces) again += piece;
      ASSERT_EQ(seen, again);
      const std::size_t count = seen.empty() ? 0 : random.below(seen.size() + 1);
      taken += seen.substr(0, count);
      output.take(count);
      ASSERT_EQ(output.size() + taken.size(), expected.size());
    }
    ASSERT_EQ(taken + drain(output, 1 + random.below(100)), expected);
    EXPECT_EQ(output.readingBytes(), 0u);
  }
}

TEST(Output, SendsTheWordsOfAReadingFromWhereTheyLie) {
  Output output;
  const auto reading = picture(10'000);
  output.add("head\n");
  output.add(reading);
  std::vector<std::string_view> pieces;
  output.look(output.size(), pieces);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(static_cast<const void*>(pieces[1].data()), reading->words.data());
  EXPECT_EQ(output.readingBytes(), 40'000u);
}

// From the world's message to the socket nothing of a picture is copied.
TEST(RobotReadings, GiveAPictureToAllClientsWithoutACopy) {
  const SensorId id{"camera", "image", "front"};
  RobotReadings readings(1, "r", {{id, "pixels"}});
  std::vector<Message> frame = {*picture(230'400)};
  const std::uint32_t* const pixels = frame[0].words.data();
  readings.publish(frame);
  const Choice choice{{}, false, true};
  for (int client = 0; client < 2; ++client) {
    std::vector<std::uint64_t> sent;
    Output output;
    EXPECT_EQ(readings.write(choice, sent, output).readings, 1u);
    std::vector<std::string_view> pieces;
    output.look(output.size(), pieces);
    EXPECT_EQ(static_cast<const void*>(pieces.back().data()), pixels);
    // A new one does not disturb what is on its way.
    if (client == 0) continue;
    frame = {{18, id, std::vector<std::uint32_t>(230'400, 7)}};
    readings.publish(frame);
    EXPECT_EQ(pieces.back().substr(4, 4), std::string_view("\xB1\x79\x37\x9E", 4));
  }
}

TEST(RobotReadings, TellWhatIsWantedWheneverThatHasChanged) {
  const SensorId front{"camera", "image", "front"};
  const SensorId back{"camera", "image", "back"};
  using Wanted = std::vector<SensorId>;
  RobotReadings readings(1, "r", {{front, ""}, {back, ""}});
  const auto ask = [&](std::vector<Query> queries) {
    std::vector<std::uint64_t> sent;
    Output output;
    readings.write({std::move(queries), false, false}, sent, output);
  };
  std::vector<Message> none;
  EXPECT_FALSE(readings.takeWanted()) << "nobody has asked";
  ask({});
  EXPECT_FALSE(readings.takeWanted()) << "whatever there is: nobody needs more for that";
  ask({Query("*/*/*")});
  EXPECT_EQ(readings.takeWanted(), (Wanted{front, back}));
  EXPECT_FALSE(readings.takeWanted()) << "that was told";
  for (std::uint64_t cycle = 1; cycle < RobotReadings::kPatience; ++cycle) readings.publish(none);
  ask({Query("*/*/back")});
  EXPECT_FALSE(readings.takeWanted()) << "for a while it remembers";
  readings.publish(none);
  EXPECT_EQ(readings.takeWanted(), Wanted{back});
  readings.forget();
  EXPECT_EQ(readings.takeWanted(), Wanted{back}) << "a new world has to be told";
  for (std::uint64_t cycle = 0; cycle < RobotReadings::kPatience; ++cycle) readings.publish(none);
  EXPECT_EQ(readings.takeWanted(), Wanted{});
}

}  // namespace
}  // namespace ortung::server

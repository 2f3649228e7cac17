// What a referee decides is in the record of a robot.
#include <gtest/gtest.h>

#include "Paths.hpp"
#include "Program.hpp"
#include "Workspace.hpp"
#include "ortung/formats/TalkData.hpp"
#include "ortung/records/RecordSource.hpp"

namespace ortung::test {
namespace {

using RefereeRecord = Workspace;

TEST_F(RefereeRecord, HasTheRefereesEvents) {
  const std::string record = path("game.rec");
  const Outcome outcome =
      ortung({"sim", ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml", "--referee",
              "soccer:league=f2000", "--player", "wander:robot=pioneer.toml&start=-3,2,0@blue",
              "--duration", "20", "--free-run", "--record", record});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  std::vector<std::string> events;
  RecordSource reader(record);
  Message message;
  while (reader.next(message)) {
    if (message.id != SensorId{"referee", "referee", "events"}) continue;
    TalkData told(message.id);
    told.setData(message.stamp, message.words);
    for (const TalkData::Message& one : told.reading().messages) {
      EXPECT_EQ(one.from, "referee");
      events.push_back(one.text);
    }
  }
  // What is printed is what is recorded.
  ASSERT_GE(events.size(), 2u);
  std::size_t at = 0;
  for (const std::string& event : events) {
    at = outcome.out.find("  " + event + "\n", at);
    ASSERT_NE(at, std::string::npos) << event;
  }
}

}  // namespace
}  // namespace ortung::test

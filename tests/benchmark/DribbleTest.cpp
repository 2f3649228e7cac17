#include <gtest/gtest.h>

#include "PlainStage.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {
namespace {

// Its kicker does not work: the ball stays where it is. Then it kicks again when 0.4 s are over,
// and stands until then.
TEST(Dribble, KicksAgainAfterSomeTimeIfTheBallIsStillThere) {
  for (const char* kind : {"dribble", "feint"}) {
    PluginFactory factory(PluginFactory::standardFolders());
    Parameters options;
    options.set("kind", kind);
    const auto player = factory.make<Player>("striker", options);
    test::Play play(3);
    player->begin(play.seat);
    Pose2& robot = play.stands.all[0].pose;
    const Pose2 ball = inverse(robot) * play.stands.balls[0].pose;  // between its horns
    std::vector<Timestamp> kicks;
    for (play.stands.time = 0; play.stands.time < 10'000'000; play.stands.time += 20'000) {
      play.notes.text.clear();
      ASSERT_TRUE(player->senseAndAct(play.seat));
      const std::string& told = play.notes.text;
      if (told.find("kicker kick") != told.npos) {
        kicks.push_back(play.stands.time);
        continue;
      }
      double v = 0.0;
      double w = 0.0;
      const std::size_t turn = told.find("w ");
      const std::size_t drive = told.find("v ");
      ASSERT_TRUE(turn != told.npos && drive != told.npos) << told;
      v = std::stod(told.substr(drive + 2));
      w = std::stod(told.substr(turn + 2));
      if (!kicks.empty()) {
        ASSERT_TRUE(v == 0.0 && w == 0.0) << kind << " at " << play.stands.time << "\n" << told;
      }
      robot = robot * Pose2{0.02 * v, 0.0, 0.02 * w};
      play.stands.balls[0].pose = robot * ball;
    }
    ASSERT_GT(kicks.size(), 3u) << kind;
    for (std::size_t i = 1; i < kicks.size(); ++i)
      EXPECT_EQ(kicks[i] - kicks[i - 1], 420'000) << kind << ": the first cycle after 0.4 s";
  }
}

}  // namespace
}  // namespace ortung

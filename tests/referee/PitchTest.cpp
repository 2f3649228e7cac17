#include <gtest/gtest.h>

#include "FakeWorld.hpp"
#include "Files.hpp"
#include "Paths.hpp"
#include "Pitch.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::soccer {
namespace {

Pitch pitchOf(const char* field, const Rules::Pitch& rules = {}) {
  return Pitch::of(*readWorld(std::string(ORTUNG_SOURCE_DIR "/maps/fields/") + field + ".toml"),
                   rules);
}

struct Expected {
  double length, width, goal, depth, circle, mark;
  AreaSize goalArea, penaltyArea;
};

/// All figures are those of the field's rules, which the heads of the world files tell.
void expectPitch(const char* field, const Expected& e) {
  const Pitch pitch = pitchOf(field);
  EXPECT_NEAR(2.0 * pitch.halfLength, e.length, 1e-9) << field;
  EXPECT_NEAR(2.0 * pitch.halfWidth, e.width, 1e-9) << field;
  EXPECT_NEAR(2.0 * pitch.halfGoal, e.goal, 1e-3) << field;
  EXPECT_NEAR(pitch.goalDepth, e.depth, 0.11) << field;  // to the outside of its back
  EXPECT_NEAR(pitch.circle, e.circle, 1e-9) << field;
  EXPECT_NEAR(pitch.penaltyMark, e.mark, 1e-9) << field;
  EXPECT_NEAR(pitch.goalArea.depth, e.goalArea.depth, 1e-9) << field;
  EXPECT_NEAR(pitch.goalArea.width, e.goalArea.width, 1e-9) << field;
  EXPECT_NEAR(pitch.penaltyArea.depth, e.penaltyArea.depth, 1e-9) << field;
  EXPECT_NEAR(pitch.penaltyArea.width, e.penaltyArea.width, 1e-9) << field;
}

TEST(Pitch, OfTheFieldsThatShip) {
  expectPitch("f2000", {12, 8, 2.0, 0.5, 1, 2, {0.5, 3}, {1.5, 5}});
  expectPitch("msl", {22, 14, 2.4, 0.75, 2, 3.6, {0.75, 3.9}, {2.25, 6.9}});
  expectPitch("soccer18x12", {18, 12, 2.0, 0.5, 2, 3, {0.75, 3.9}, {2.25, 6.9}});
}

TEST(Pitch, RulesHoldInSpiteOfLines) {
  Rules::Pitch rules;
  rules.length = 20.0;
  rules.width = 13.0;
  rules.goalWidth = 2.2;
  rules.goalDepth = 0.6;
  rules.circle = 1.5;
  rules.penaltyMark = 3.0;
  rules.goalArea = AreaSize{1.0, 4.0};
  rules.penaltyArea = AreaSize{2.0, 6.0};
  const Pitch pitch = pitchOf("msl", rules);
  EXPECT_EQ(pitch.halfLength, 10.0);
  EXPECT_EQ(pitch.halfWidth, 6.5);
  EXPECT_EQ(pitch.halfGoal, 1.1);
  EXPECT_EQ(pitch.goalDepth, 0.6);
  EXPECT_EQ(pitch.circle, 1.5);
  EXPECT_EQ(pitch.penaltyMark, 3.0);
  EXPECT_EQ(pitch.goalArea.depth, 1.0);
  EXPECT_EQ(pitch.penaltyArea.width, 6.0);
}

TEST(Pitch, AWorldWithoutGoalsNeedsAKeyThatTheErrorNames) {
  const FakeWorld room(10.0, 8.0);
  const auto errorOf = [&](const Rules::Pitch& rules) {
    return test::messageOf<ConfigError>([&] { Pitch::of(room, rules); });
  };
  Rules::Pitch rules;
  EXPECT_NE(errorOf(rules).find("[pitch] length_m"), std::string::npos) << errorOf(rules);
  rules.length = 9.0;
  EXPECT_NE(errorOf(rules).find("[pitch] width_m"), std::string::npos) << errorOf(rules);
  rules.width = 6.0;
  EXPECT_NE(errorOf(rules).find("[pitch] goal_width_m"), std::string::npos) << errorOf(rules);
  rules.goalWidth = 1.0;
  EXPECT_EQ(Pitch::of(room, rules).halfGoal, 0.5);
}

TEST(Pitch, KnowsWhatIsInAnArea) {
  const Pitch pitch = pitchOf("msl");
  EXPECT_TRUE(pitch.isIn(pitch.goalArea, 1.0, 10.3, 1.9));
  EXPECT_FALSE(pitch.isIn(pitch.goalArea, 1.0, 10.2, 1.9));
  EXPECT_FALSE(pitch.isIn(pitch.goalArea, 1.0, 10.3, 2.0));
  EXPECT_FALSE(pitch.isIn(pitch.goalArea, -1.0, 10.3, 0.0));
  EXPECT_TRUE(pitch.isIn(pitch.penaltyArea, -1.0, -8.8, -3.4));
  EXPECT_FALSE(pitch.isIn(pitch.penaltyArea, -1.0, -11.1, 0.0));
}

}  // namespace
}  // namespace ortung::soccer

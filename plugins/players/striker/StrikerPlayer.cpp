// Attacks a goal from situations that it makes itself; goalkeepers are benchmarked by it.
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "Attack.hpp"
#include "Dribblers.hpp"
#include "Shots.hpp"
#include "YardstickV1.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

const std::vector<std::string> kKinds = {"roll",  "shot",   "dribble",
                                         "feint", "seeker", "yardstick-v1"};

class StrikerPlayer : public Player {
 public:
  explicit StrikerPlayer(const Parameters& p)
      : kind_(p.choiceOr("kind", "shot", kKinds)),
        again_(p.numberOr("again_s", 0.0, {0.0, 1e6})),
        own_(OwnSight::read(p, kind_ == "seeker" ? "localized" : "truth")),
        isBlind_(p.choiceOr("aim", "open", {"open", "random"}) == "random") {
    const bool mayLook = kind_ == "dribble" || kind_ == "feint" || kind_ == "seeker";
    if (!mayLook && own_ != SightMode::kTruth)
      p.fail("sees", "must be truth for the kind '" + kind_ + "', which uses the stage");
    attack_.halfMouth = p.numberOr("goal_width_m", 2.0, {0.3, 20.0}) / 2.0;
    attack_.braking = p.numberOr("braking_m_s2", attack_.braking, {0.0, 10.0});
  }

  std::filesystem::path robotFile() const override { return OwnSight(own_).robotFile("striker"); }
  double period() const override { return 0.02; }
  bool needsStage() const override { return true; }
  bool needsTables() const override { return OwnSight(own_).needsTables(); }
  std::optional<BelievedPose> believedPose() const override {
    return strike_ ? strike_->believedPose() : std::nullopt;
  }

  void begin(PlayerSeat& seat) override {
    attack_.goal = GoalSide::at(seat.field(), seat.game().directionOf(seat.team()));
    if (kind_ == "roll") strike_ = std::make_unique<Roll>(attack_, isBlind_);
    if (kind_ == "shot") strike_ = std::make_unique<Shot>(attack_);
    if (kind_ == "dribble") strike_ = std::make_unique<Dribble>(attack_, own_);
    if (kind_ == "feint") strike_ = std::make_unique<Feint>(attack_, own_);
    if (kind_ == "seeker") strike_ = std::make_unique<Seek>(attack_, own_);
    if (kind_ == "yardstick-v1") strike_ = std::make_unique<YardstickV1>(attack_.goal);
    setUp(seat);
  }

  bool senseAndAct(PlayerSeat& seat) override {
    if (again_ > 0.0 && toSeconds(seat.now() - begun_) >= again_) setUp(seat);
    strike_->act(seat);
    return true;
  }

 private:
  void setUp(PlayerSeat& seat) {
    constexpr int kTries = 50;
    begun_ = seat.now();
    for (int i = 0; i < kTries; ++i)
      if (strike_->setUp(seat)) return;
    throw std::runtime_error("found no room for robot and ball in " + std::to_string(kTries) +
                             " situations");
  }

  std::string kind_;
  double again_;  ///< time between two situations [s]; 0: only one
  SightMode own_;
  bool isBlind_;
  Attack attack_;
  std::unique_ptr<Strike> strike_;
  Timestamp begun_ = 0;
};

struct StrikerHelp : PlayerHelp {
  explicit StrikerHelp(const Parameters&)
      : PlayerHelp("attacks a goal from situations that it makes, to benchmark goalkeepers",
                   {{"kind", "roll|shot|dribble|feint|seeker|yardstick-v1", "shot",
                     "a ball that rolls, a free shot, a dribbler, one that draws the keeper aside, "
                     "one that finds the ball; yardstick-v1 never changes"},
                    {kSeesOption.key, kSeesOption.unit, "truth; of seeker localized",
                     "how dribble, feint and seeker know where they, ball and keeper are"},
                    {"aim", "open|random", "open", "where roll aims: past the keeper or anywhere"},
                    {"again_s", "s", "0", "how often it makes another situation; 0: only once"},
                    {"goal_width_m", "m", "2", "distance between the posts"},
                    {"braking_m_s2", "m/s^2", "0.2943", "deceleration of a rolling ball"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("striker", ortung::provide<ortung::Player, ortung::StrikerPlayer>("striker"),
               ortung::provide<ortung::PlayerHelp, ortung::StrikerHelp>("striker"));

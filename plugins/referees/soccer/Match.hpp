#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "AreaFouls.hpp"
#include "BallOut.hpp"
#include "BallStuck.hpp"
#include "MatchClock.hpp"
#include "Orders.hpp"
#include "Pitch.hpp"
#include "Restarts.hpp"
#include "Rules.hpp"
#include "Scene.hpp"
#include "Touches.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung::soccer {

/// How decisions are made: by the rules, or by orders of a person (a referee box) alone.
enum class Control { kRules, kOrders };

/// A game of two teams: combines the observations of the other classes, and decides what follows.
class Match {
 public:
  struct Config {
    Rules rules;
    Control control = Control::kRules;
    std::array<std::string, 2> teams = {"blue", "yellow"};
    std::size_t kickOff = 0;  ///< index of the team with the first kick-off
    std::size_t left = 0;     ///< index of the team that begins on the left
    int matches = 1;          ///< number of consecutive matches, each from 0:0; 0: endless
  };

  explicit Match(Config config);

  const Game& watch(Stage& stage);
  std::vector<RefereeEvent> takeEvents();
  bool holds(std::string_view robot) const;
  /// Checks an order, which is executed at the next watch(). @throws std::invalid_argument
  void order(std::string_view text);

 private:
  void obey(Stage& stage, const Order& order);
  void start(Stage& stage);
  void beginHalf(Stage& stage, int half);
  void reset();

  void countTime(double elapsed);
  void endHalf();
  void endGame();
  void beginNextMatch();
  void whileStopped(Stage& stage);
  void whileReady(Stage& stage);
  void whilePlaying(Stage& stage);
  void leave(Stage& stage, const Leaving& leaving);
  void judgeGoal(Stage& stage, const Leaving& leaving);
  void give(Stage& stage, const Restart& restart, const std::string& why);
  void giveAt(Stage& stage, Game::Restart kind, std::optional<std::size_t> team,
              const FloorPoint& at, const std::string& why);
  void place(Stage& stage);
  void begin(Stage& stage);
  void play();
  void forgetPlay();
  bool hasNewcomer() const;

  FloorPoint ballPlace() const;
  std::string nameOfTeam(std::optional<std::size_t> team) const;
  void tell(const std::string& what, std::optional<std::size_t> team, const std::string& text);

  const Config config_;
  Game game_;
  MatchClock clock_;
  Touches touches_;
  BallOut ballOut_;
  BallStuck stuck_;
  AreaFouls areas_;
  std::optional<Pitch> pitch_;
  Scene scene_;
  std::optional<Timestamp> last_;  ///< time of the last cycle

  std::optional<Restart> restart_;   ///< the restart while it is prepared or to be taken
  bool waits_ = false;               ///< whether the restart waits for the order to start
  bool isPause_ = false;             ///< whether it is a pause between halves or matches
  int match_ = 1;                    ///< number of the current match, from 1
  Timestamp since_ = 0;              ///< time at which this phase began
  std::vector<std::string> placed_;  ///< robots that were present when the restart was given

  std::vector<Order> orders_;
  std::vector<RefereeEvent> events_;
};

}  // namespace ortung::soccer

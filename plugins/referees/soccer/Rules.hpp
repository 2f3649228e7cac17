#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/sim_api/Game.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung::soccer {

/// Depth and width of an area before a goal [m].
struct AreaSize {
  double depth = 0.0;
  double width = 0.0;
};

/// The constants of a game, as a rules file says them (docs/referee.md). Lengths [m], times [s].
struct Rules {
  struct Match {
    int halves = 2;
    double half = 600.0;
    double pause = 0.0;  ///< between halves
    int overtimeHalves = 0;
    double overtimeHalf = 300.0;
    bool clockStops = false;  ///< it counts only while the ball is in play
    bool sidesChange = true;
  } match;

  /// What the lines of the world do not say, or what is to hold in spite of them.
  struct Pitch {
    std::optional<double> length, width, goalWidth, goalDepth, circle, penaltyMark;
    std::optional<AreaSize> goalArea, penaltyArea;
  } pitch;

  struct Ball {
    double radius = 0.11;       ///< where the world does not tell
    double touchMargin = 0.02;  ///< nearer to a body than that, it is touched
  } ball;

  struct Out {
    bool hasThrowIn = true;  ///< else the ball is put back where it left
    bool hasKicks = true;    ///< goal kick and corner; else likewise
    bool wholeBall = true;   ///< must be over the line; else its middle
    double margin = 0.0;     ///< by which more it must be over
    double putBack = 0.3;    ///< how far inside it is put back
  } out;

  struct Goal {
    bool wholeBall = true;
    bool fromOwnHalf = true;            ///< counts if it was last touched there
    std::vector<Game::Restart> direct;  ///< restarts from which the taker may score
  } goal;

  struct Restart {
    double placing = 1.0;    ///< all are held from the whistle to the restart
    double setPiece = 10.0;  ///< after which everybody may play
    double inPlay = 0.1;     ///< that the ball must have moved
    double keepAway = 2.0;   ///< of the other team's robots, to their edge
    double ownKeepAway = 0.0;
    double droppedBall = 1.0;  ///< of all robots
    bool keeperStays = true;   ///< in its own penalty area
  } restart;

  struct Places {
    std::optional<double> goalKickDepth, goalKickAside;  ///< else the corner of the goal area
    double cornerInside = 0.0;
    double throwInInside = 0.0;
    std::optional<double> marksX;  ///< of the four restart marks; none if there is none
    double marksY = 0.25;          ///< share of the pitch's width
    bool dropsAtMark = false;      ///< else where the ball is
    bool freeKickAtMark = false;   ///< those in a penalty area
  } places;

  struct Stuck {
    double radius = 0.2;  ///< it stays within
    double time = 10.0;   ///< 0: the rule is off
  } stuck;

  /// Most robots of one team in an area; nothing: as many as like to.
  struct Areas {
    std::optional<int> ownGoal, ownPenalty, otherGoal, otherPenalty;
    double time = 1.0;  ///< for which more are tolerated
    Game::Restart restart = Game::Restart::kFreeKick;
  } areas;

  /// Where robots stand at a kick-off, in shares of half the length and half the width; x from -1,
  /// the own goal line, to 0.
  struct KickOff {
    std::vector<FloorPoint> own;    ///< of the team that has it; the last one that comes takes it
    std::vector<FloorPoint> other;  ///< of the other
    double taker = 0.1;             ///< its distance to the ball, edge to edge
  } kickOff;
};

/// @throws ConfigError with file and line for what is no rule, or out of its range
Rules readRules(const std::filesystem::path& file);

/// The file of rules that ship under this name, as all shipped files are found. @throws ConfigError
std::filesystem::path shippedRules(const std::string& name);

}  // namespace ortung::soccer

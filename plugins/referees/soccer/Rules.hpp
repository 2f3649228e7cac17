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

/// The constants of a game from a rules file (docs/referee.md). Lengths are in [m], times in [s].
struct Rules {
  struct Match {
    int halves = 2;
    double half = 600.0;
    double pause = 0.0;  ///< pause between halves
    int overtimeHalves = 0;
    double overtimeHalf = 300.0;
    bool clockStops = false;  ///< whether it counts only while the ball is in play
    bool sidesChange = true;
  } match;

  /// Sizes that the lines of the world do not give, or that override them.
  struct Pitch {
    std::optional<double> length, width, goalWidth, goalDepth, circle, penaltyMark;
    std::optional<AreaSize> goalArea, penaltyArea;
  } pitch;

  struct Ball {
    double radius = 0.11;       ///< default radius of the ball if the world has none
    double touchMargin = 0.02;  ///< gap to a body below which it is touched
  } ball;

  struct Out {
    /// Whether there are throw-ins; otherwise the ball is put back where it left.
    bool hasThrowIn = true;
    /// Whether there are goal kicks and corners; otherwise the ball is put back.
    bool hasKicks = true;
    bool wholeBall = true;  ///< whether the whole ball must be over the line; otherwise its middle
    double margin = 0.0;    ///< further distance that it must be over the line
    double putBack = 0.3;   ///< distance inside of the line at which it is put back
  } out;

  struct Goal {
    bool wholeBall = true;
    /// Whether a goal counts if the ball was last touched in the own half.
    bool fromOwnHalf = true;
    std::vector<Game::Restart> direct;  ///< restarts from which the taker may score
  } goal;

  struct Restart {
    double placing = 1.0;    ///< time from the whistle to the restart, while all robots are held
    double setPiece = 10.0;  ///< time after which all robots may play
    double inPlay = 0.1;     ///< distance that the ball must have moved to be in play
    /// Least distance of the other team's robots from the ball, to their edges.
    double keepAway = 2.0;
    double ownKeepAway = 0.0;
    double droppedBall = 1.0;  ///< least distance of all robots from a dropped ball
    bool keeperStays = true;   ///< whether the keeper may stay in its own penalty area
  } restart;

  struct Places {
    /// Place of goal kicks; otherwise the corner of the goal area.
    std::optional<double> goalKickDepth, goalKickAside;
    double cornerInside = 0.0;
    double throwInInside = 0.0;
    std::optional<double> marksX;  ///< |x| of the four restart marks; nothing: there are none
    double marksY = 0.25;          ///< |y| of the marks as a share of the pitch's width
    bool dropsAtMark = false;     ///< whether balls are dropped at a mark; otherwise where they are
    bool freeKickAtMark = false;  ///< whether free kicks in a penalty area are taken at a mark
  } places;

  struct Stuck {
    double radius = 0.2;  ///< radius of the circle in which a stuck ball stays
    double time = 10.0;   ///< time until it is stuck; 0: the rule is off
  } stuck;

  /// Greatest number of robots of one team in an area; nothing: no limit.
  struct Areas {
    std::optional<int> ownGoal, ownPenalty, otherGoal, otherPenalty;
    double time = 1.0;  ///< time for which more robots are tolerated
    Game::Restart restart = Game::Restart::kFreeKick;
  } areas;

  /// The places of robots at a kick-off, in shares of half the length and half the width; x from
  /// -1, the own goal line, to 0.
  struct KickOff {
    std::vector<FloorPoint> own;  ///< places of the team with the kick-off; its last robot takes it
    std::vector<FloorPoint> other;  ///< places of the other team
    double taker = 0.1;             ///< distance of the taker from the ball, edge to edge
  } kickOff;
};

/// Reads a rules file. @throws ConfigError with file and line for an unknown rule, or a value out
/// of its range
Rules readRules(const std::filesystem::path& file);

/// Returns the file of the shipped rules of this name. @throws ConfigError
std::filesystem::path shippedRules(const std::string& name);

}  // namespace ortung::soccer

#include "Rules.hpp"

#include <limits>

#include "ortung/core/ShippedFiles.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::soccer {
namespace {

constexpr Range kLength{0.0, 1000.0};  // [m]
constexpr Range kSize{0.01, 1000.0};   // sizes that must not be 0 [m]
constexpr Range kTime{0.0, 1e6};       // [s]
constexpr Range kRobots{0.0, 1000.0};
constexpr std::size_t kMostPlaces = 64;  // greatest number of places of robots at a kick-off

void readMaybe(const Parameters& p, const char* key, const Range& range,
               std::optional<double>& value) {
  if (p.has(key)) value = p.number(key, range);
}

void readMaybe(const Parameters& p, const char* key, std::optional<AreaSize>& value) {
  if (!p.has(key)) return;
  const auto sizes = p.numbers(key, 2, kSize);
  value = AreaSize{sizes[0], sizes[1]};
}

/// Reads a limit; "off" removes the one of the base file.
void readMost(const Parameters& p, const char* key, std::optional<int>& value) {
  if (!p.has(key)) return;
  const auto most = p.integer(key, {-1.0, kRobots.high});
  value = most < 0 ? std::nullopt : std::optional<int>(static_cast<int>(most));
}

void readMatch(const Parameters& p, Rules::Match& m) {
  m.halves = static_cast<int>(p.integerOr("halves", m.halves, {1.0, 100.0}));
  m.half = p.numberOr("half_s", m.half, {1.0, kTime.high});
  m.pause = p.numberOr("pause_s", m.pause, kTime);
  m.overtimeHalves = static_cast<int>(p.integerOr("overtime_halves", m.overtimeHalves, {0.0, 100}));
  m.overtimeHalf = p.numberOr("overtime_half_s", m.overtimeHalf, {1.0, kTime.high});
  m.clockStops = p.flagOr("clock_stops", m.clockStops);
  m.sidesChange = p.flagOr("sides_change", m.sidesChange);
}

void readPitch(const Parameters& p, Rules::Pitch& pitch) {
  readMaybe(p, "length_m", {1.0, kSize.high}, pitch.length);
  readMaybe(p, "width_m", {1.0, kSize.high}, pitch.width);
  readMaybe(p, "goal_width_m", kSize, pitch.goalWidth);
  readMaybe(p, "goal_depth_m", kSize, pitch.goalDepth);
  readMaybe(p, "centre_circle_m", kSize, pitch.circle);
  readMaybe(p, "penalty_mark_m", kSize, pitch.penaltyMark);
  readMaybe(p, "goal_area_m", pitch.goalArea);
  readMaybe(p, "penalty_area_m", pitch.penaltyArea);
}

void readBall(const Parameters& p, Rules::Ball& ball) {
  ball.radius = p.numberOr("radius_m", ball.radius, {0.01, 1.0});
  ball.touchMargin = p.numberOr("touch_margin_m", ball.touchMargin, {0.0, 1.0});
}

bool isSetPiece(const Parameters& p, const char* key, bool fallback, const char* setPiece) {
  return p.choiceOr(key, fallback ? setPiece : "put-back", {setPiece, "put-back"}) == setPiece;
}

void readOut(const Parameters& p, Rules::Out& out) {
  out.hasThrowIn = isSetPiece(p, "touch_line", out.hasThrowIn, "throw-in");
  out.hasKicks = isSetPiece(p, "goal_line", out.hasKicks, "kicks");
  out.wholeBall = p.flagOr("whole_ball", out.wholeBall);
  out.margin = p.numberOr("margin_m", out.margin, {0.0, 10.0});
  out.putBack = p.numberOr("put_back_m", out.putBack, {0.0, 10.0});
}

void readGoal(const Parameters& p, Rules::Goal& goal) {
  goal.wholeBall = p.flagOr("whole_ball", goal.wholeBall);
  goal.fromOwnHalf = p.flagOr("from_own_half", goal.fromOwnHalf);
  if (!p.has("direct_from")) return;
  goal.direct.clear();
  for (const std::string& name : p.texts("direct_from")) {
    const auto restart = restartOf(name);
    if (!restart || *restart == Game::Restart::kNone)
      p.fail("direct_from",
             "holds '" + name +
                 "', expected kick-off, throw-in, goal-kick, corner, free-kick, penalty or "
                 "dropped-ball");
    goal.direct.push_back(*restart);
  }
}

void readRestart(const Parameters& p, Rules::Restart& r) {
  r.placing = p.numberOr("placing_s", r.placing, kTime);
  r.setPiece = p.numberOr("set_piece_s", r.setPiece, kTime);
  r.inPlay = p.numberOr("in_play_m", r.inPlay, {0.001, 10.0});
  r.keepAway = p.numberOr("keep_away_m", r.keepAway, {0.0, 100.0});
  r.ownKeepAway = p.numberOr("own_keep_away_m", r.ownKeepAway, {0.0, 100.0});
  r.droppedBall = p.numberOr("dropped_ball_keep_away_m", r.droppedBall, {0.0, 100.0});
  r.keeperStays = p.flagOr("keeper_stays", r.keeperStays);
}

void readPlaces(const Parameters& p, Rules::Places& places) {
  readMaybe(p, "goal_kick_depth_m", kLength, places.goalKickDepth);
  readMaybe(p, "goal_kick_aside_m", kLength, places.goalKickAside);
  places.cornerInside = p.numberOr("corner_inside_m", places.cornerInside, {0.0, 10.0});
  places.throwInInside = p.numberOr("throw_in_inside_m", places.throwInInside, {0.0, 10.0});
  readMaybe(p, "marks_x_m", kLength, places.marksX);
  places.marksY = p.numberOr("marks_y_share", places.marksY, {0.0, 0.5});
  const auto atMark = [&p, &places](const char* key, bool fallback, const char* other) {
    const bool is = p.choiceOr(key, fallback ? "mark" : other, {"mark", other}) == "mark";
    if (is && !places.marksX) p.fail(key, "is 'mark', but there is no marks_x_m");
    return is;
  };
  places.dropsAtMark = atMark("dropped_ball", places.dropsAtMark, "where-it-is");
  places.freeKickAtMark = atMark("free_kick_in_penalty_area", places.freeKickAtMark, "where-it-is");
}

void readStuck(const Parameters& p, Rules::Stuck& stuck) {
  stuck.radius = p.numberOr("radius_m", stuck.radius, {0.001, 100.0});
  stuck.time = p.numberOr("time_s", stuck.time, kTime);
}

void readAreas(const Parameters& p, Rules::Areas& areas) {
  readMost(p, "own_goal_area", areas.ownGoal);
  readMost(p, "own_penalty_area", areas.ownPenalty);
  readMost(p, "other_goal_area", areas.otherGoal);
  readMost(p, "other_penalty_area", areas.otherPenalty);
  areas.time = p.numberOr("time_s", areas.time, kTime);
  areas.restart = *restartOf(p.choiceOr("restart", std::string(nameOf(areas.restart)),
                                        {"free-kick", "penalty", "dropped-ball"}));
}

void readPlacesOf(const Parameters& p, const char* key, std::vector<FloorPoint>& places) {
  if (!p.has(key)) return;
  const auto numbers = p.numbers(key, -1, {-1.0, 1.0});
  if (numbers.size() % 2 != 0)
    p.fail(key, "has " + std::to_string(numbers.size()) + " numbers, expected pairs of x and y");
  if (numbers.size() > 2 * kMostPlaces)
    p.fail(key, "has more than " + std::to_string(kMostPlaces) + " places");
  places.clear();
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    if (numbers[i] > 0.0) p.fail(key, "has an x above 0, which is not in the own half");
    places.push_back({numbers[i], numbers[i + 1]});
  }
}

void readKickOff(const Parameters& p, Rules::KickOff& kickOff) {
  readPlacesOf(p, "own", kickOff.own);
  readPlacesOf(p, "other", kickOff.other);
  kickOff.taker = p.numberOr("taker_m", kickOff.taker, {0.0, 10.0});
}

/// Reads a rules file. @param depth 0, or 1 for a base
Rules read(const std::filesystem::path& file, int depth) {
  const Parameters p = readToml(file);
  Rules rules;
  if (p.has("base")) {
    if (depth > 0) p.fail("base", "is in a file that is itself a base; bases have none");
    const std::string base = p.text("base");
    const bool isFile = base.ends_with(".toml");
    rules = read(isFile ? file.parent_path() / base : shippedRules(base), depth + 1);
  }
  readMatch(p.table("match"), rules.match);
  readPitch(p.table("pitch"), rules.pitch);
  readBall(p.table("ball"), rules.ball);
  readOut(p.table("out"), rules.out);
  readGoal(p.table("goal"), rules.goal);
  readRestart(p.table("restart"), rules.restart);
  readPlaces(p.table("places"), rules.places);
  readStuck(p.table("stuck"), rules.stuck);
  readAreas(p.table("areas"), rules.areas);
  readKickOff(p.table("kick_off"), rules.kickOff);
  p.refuseUnread();
  return rules;
}

}  // namespace

Rules readRules(const std::filesystem::path& file) { return read(file, 0); }

std::filesystem::path shippedRules(const std::string& name) {
  if (name.empty() || name.find_first_of("/\\") != name.npos)
    throw ConfigError("'" + name +
                      "' is not the name of shipped rules; names of files end in .toml");
  // The folder is part of the name, so that a world file of that name in the working folder is not
  // mistaken for it.
  const auto file = shippedFile(".", std::filesystem::path("rules") / (name + ".toml"));
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) return file;
  throw ConfigError("there are no rules '" + name + "' among those that ship (" + file.string() +
                    "); ORTUNG_MAPS_PATH may name the folder of the maps");
}

}  // namespace ortung::soccer

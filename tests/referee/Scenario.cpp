#include "Scenario.hpp"

#include "ortung/base/Angles.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::test {
namespace {

constexpr Range kPlace{-1000.0, 1000.0};
constexpr Range kSpeed{-100.0, 100.0};

Pose2 poseOf(const Parameters& p, const char* key) {
  const auto numbers = p.numbers(key, 3, kPlace);
  return {numbers[0], numbers[1], radians(numbers[2])};
}

Twist velocityOf(const Parameters& p) {
  const auto numbers = p.numbersOr("velocity_m_s", {0.0, 0.0}, 2, kSpeed);
  return {numbers[0], numbers[1], 0.0};
}

FloorPoint pointOf(const Parameters& p, const char* key) {
  const auto numbers = p.numbers(key, 2, kPlace);
  return {numbers[0], numbers[1]};
}

StagedThing ballOf(const Parameters& p) {
  const FloorPoint at = pointOf(p, "at_m");
  return {"ball", "ball", {at.x, at.y, 0.0}, velocityOf(p)};
}

StagedRobot robotOf(const Parameters& p) {
  return {p.text("name"), p.textOr("team", ""), poseOf(p, "pose"), velocityOf(p),
          p.numberOr("radius_m", 0.25, {0.05, 1.0})};
}

std::vector<std::string> textsOf(const Parameters& p, const char* key) {
  return p.has(key) ? p.texts(key) : std::vector<std::string>{};
}

template <class Value>
Value named(const Parameters& p, const char* key, std::optional<Value> value) {
  if (!value) p.fail(key, "is no name of that kind");
  return *value;
}

Expectation::Robot robotExpectation(const Parameters& p) {
  Expectation::Robot robot{p.text("name"), {}, {}, {}};
  if (p.has("at_m")) robot.place = pointOf(p, "at_m");
  if (p.has("from_ball_m")) robot.fromBall = p.number("from_ball_m", {0.0, 1000.0});
  if (p.has("in_own_half")) robot.isInOwnHalf = p.flagOr("in_own_half", true);
  return robot;
}

Expectation expectationOf(const Parameters& p) {
  Expectation e;
  if (p.has("phase")) e.phase = named(p, "phase", phaseOf(p.text("phase")));
  if (p.has("restart")) e.restart = named(p, "restart", restartOf(p.text("restart")));
  if (p.has("restart_of")) e.restartOf = p.text("restart_of");
  if (p.has("score")) {
    const auto score = p.numbers("score", 2, {0.0, 1000.0});
    e.score = {static_cast<int>(score[0]), static_cast<int>(score[1])};
  }
  if (p.has("half")) e.half = static_cast<int>(p.integer("half", {0.0, 100.0}));
  if (p.has("clock_s")) e.clock = p.number("clock_s", {0.0, 1e6});
  if (p.has("left")) e.left = p.text("left");
  if (p.has("ball_m")) e.ball = pointOf(p, "ball_m");
  if (p.has("ball_rests")) e.ballRests = p.flagOr("ball_rests", true);
  e.tolerance = p.numberOr("tolerance_m", e.tolerance, {0.0, 100.0});
  for (const Parameters& robot : p.tables("robots")) e.robots.push_back(robotExpectation(robot));
  e.held = textsOf(p, "held");
  e.free = textsOf(p, "free");
  e.seen = textsOf(p, "seen");
  e.unseen = textsOf(p, "unseen");
  return e;
}

/// A robot that is there needs no team; where it is said to be it stands, or drives.
StagedRobot moved(const Parameters& p, const Scenario& scenario) {
  StagedRobot robot{p.text("name"),
                    p.textOr("team", ""),
                    {},
                    velocityOf(p),
                    p.numberOr("radius_m", 0.25, {0.05, 1.0})};
  for (const StagedRobot& known : scenario.robots)
    if (known.name == robot.name) {
      robot.team = known.team;
      robot.radius = known.radius;
    }
  robot.pose = poseOf(p, "pose");
  return robot;
}

Step stepOf(const Parameters& p, const Scenario& scenario) {
  Step step;
  step.at = p.number("at_s", {0.0, 1e5});
  step.orders = textsOf(p, "orders");
  if (p.has("refused")) step.refused = p.text("refused");
  if (p.has("ball")) step.ball = ballOf(p.table("ball"));
  for (const Parameters& robot : p.tables("robots")) step.robots.push_back(moved(robot, scenario));
  step.leave = textsOf(p, "leave");
  if (p.has("expect")) step.expect = expectationOf(p.table("expect"));
  return step;
}

/// The options of the referee; rules that ship are those of the maps given here.
Parameters refereeOf(const Parameters& p, const std::filesystem::path& folder,
                     const std::filesystem::path& maps) {
  Parameters options(p.where());
  const std::string rules = p.text("rules");
  options.set("rules", rules.ends_with(".toml") ? (folder / rules).string()
                                                : (maps / "rules" / (rules + ".toml")).string());
  for (const char* key : {"control", "kick_off", "left", "team_1", "team_2"})
    if (p.has(key)) options.set(key, p.text(key));
  if (p.has("matches")) options.set("matches", p.number("matches"));
  return options;
}

}  // namespace

Scenario Scenario::read(const std::filesystem::path& file, const std::filesystem::path& maps) {
  const Parameters p = readToml(file);
  Scenario s;
  s.name = file.stem().string();
  const Parameters about = p.table("scenario");
  s.about = about.text("about");
  const std::string field = about.textOr("field", "msl");
  s.field =
      field.ends_with(".toml") ? file.parent_path() / field : maps / "fields" / (field + ".toml");
  s.cycle = about.numberOr("cycle_ms", 10.0, {1.0, 1000.0}) / 1000.0;
  s.isPlaying = about.choiceOr("begins", "kick-off", {"kick-off", "playing"}) == "playing";
  s.referee = refereeOf(p.table("referee"), file.parent_path(), maps);
  if (p.has("ball")) s.ball = ballOf(p.table("ball"));
  for (const Parameters& robot : p.tables("robot")) s.robots.push_back(robotOf(robot));
  double last = 0.0;
  for (const Parameters& step : p.tables("step")) {
    s.steps.push_back(stepOf(step, s));
    s.steps.back().line = static_cast<int>(s.steps.size());
    if (s.steps.back().at < last) step.fail("at_s", "is before the step above");
    last = s.steps.back().at;
  }
  if (s.steps.empty()) p.fail("step", "is missing: a scenario without steps tests nothing");
  p.refuseUnread();
  return s;
}

}  // namespace ortung::test

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "FakeStage.hpp"
#include "Scenario.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung::test {
namespace {

constexpr double kRest = 1e-6;  // [m/s]

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

class Run {
 public:
  explicit Run(const Scenario& scenario)
      : scenario_(scenario),
        stage_(scenario.field, scenario.cycle),
        referee_(PluginFactory(PluginFactory::standardFolders())
                     .make<Referee>("soccer", scenario.referee)) {}

  std::vector<std::string> play() {
    putAll();
    if (scenario_.isPlaying) {
      referee_->order("dropped-ball");
      referee_->order("start");
      referee_->watch(stage_);
      referee_->takeEvents();
      putAll();
      step();
    }
    const Timestamp begin = stage_.now();
    for (auto next = scenario_.steps.begin(); next != scenario_.steps.end(); step()) {
      const double time = toSeconds(stage_.now() - begin);
      const auto due = std::find_if(next, scenario_.steps.end(),
                                    [&](const Step& s) { return s.at > time + 1e-9; });
      for (auto s = next; s != due; ++s) act(*s);
      game_ = referee_->watch(stage_);
      for (auto& event : referee_->takeEvents()) events_.push_back(std::move(event));
      for (; next != due; ++next) check(*next);
    }
    return problems_;
  }

 private:
  void putAll() {
    for (const StagedRobot& robot : scenario_.robots) stage_.set(robot);
    if (scenario_.ball) stage_.set(*scenario_.ball);
  }

  void step() {
    stage_.step([this](const std::string& name) { return referee_->holds(name); });
  }

  void act(const Step& step) {
    for (const StagedRobot& robot : step.robots) stage_.set(robot);
    for (const std::string& name : step.leave) stage_.remove(name);
    if (step.ball) stage_.set(*step.ball);
    for (const std::string& order : step.orders) referee_->order(order);
    if (!step.refused) return;
    try {
      referee_->order(*step.refused);
      fail(step, "the order '" + *step.refused + "' was not refused");
    } catch (const std::invalid_argument&) {  // as expected
    }
  }

  void fail(const Step& step, const std::string& what) {
    problems_.push_back("step " + std::to_string(step.line) + " at " + format("%.2f s: ", step.at) +
                        what);
  }

  template <class Value>
  void compare(const Step& step, const char* what, const std::optional<Value>& expected,
               const Value& found, const std::string& foundText) {
    if (expected && *expected != found)
      fail(step, std::string(what) + " is not as expected, but " + foundText);
  }

  void check(const Step& step) {
    if (step.expect) {
      const Expectation& e = *step.expect;
      compare(step, "the phase", e.phase, game_.phase, std::string(nameOf(game_.phase)));
      compare(step, "the restart", e.restart, game_.restart, std::string(nameOf(game_.restart)));
      const std::string of = game_.restartOf ? game_.teams[*game_.restartOf].name : "";
      compare(step, "the team of the restart", e.restartOf, of, "'" + of + "'");
      const std::array<int, 2> score = {game_.teams[0].score, game_.teams[1].score};
      compare(step, "the score", e.score, score, format("%d:%d", score[0], score[1]));
      compare(step, "the half", e.half, game_.half, std::to_string(game_.half));
      const std::string left = game_.teams[game_.teamOnTheLeft].name;
      compare(step, "the team on the left", e.left, left, left);
      if (e.clock && std::abs(*e.clock - game_.clock) > scenario_.cycle + 1e-6)
        fail(step, format("the clock is %.3f s, expected %.3f s", game_.clock, *e.clock));
      checkBall(step, e);
      for (const auto& robot : e.robots) checkRobot(step, robot, e.tolerance);
      for (const std::string& name : e.held)
        if (!referee_->holds(name)) fail(step, name + " is not held");
      for (const std::string& name : e.free)
        if (referee_->holds(name)) fail(step, name + " is held");
      checkEvents(step, e);
    }
    events_.clear();
  }

  void checkBall(const Step& step, const Expectation& e) {
    const StagedThing* ball = stage_.ball();
    if (!e.ball && !e.ballRests) return;
    if (ball == nullptr) return fail(step, "there is no ball");
    if (e.ball && !(std::hypot(ball->pose.x - e.ball->x, ball->pose.y - e.ball->y) <= e.tolerance))
      fail(step, format("the ball is at (%.3f, %.3f), expected (%.3f, %.3f)", ball->pose.x,
                        ball->pose.y, e.ball->x, e.ball->y));
    const bool rests = std::hypot(ball->velocity.x, ball->velocity.y) < kRest;
    if (e.ballRests && *e.ballRests != rests)
      fail(step, rests ? "the ball rests" : "the ball does not rest");
  }

  void checkRobot(const Step& step, const Expectation::Robot& expected, double tolerance) {
    const StagedRobot* robot = stage_.find(expected.name);
    if (robot == nullptr) return fail(step, "there is no robot " + expected.name);
    const Pose2& pose = robot->pose;
    if (expected.place &&
        !(std::hypot(pose.x - expected.place->x, pose.y - expected.place->y) <= tolerance))
      fail(step, robot->name + format(" is at (%.3f, %.3f), expected (%.3f, %.3f)", pose.x, pose.y,
                                      expected.place->x, expected.place->y));
    if (const StagedThing* ball = stage_.ball(); expected.fromBall && ball != nullptr) {
      const double gap = std::hypot(pose.x - ball->pose.x, pose.y - ball->pose.y) - robot->radius -
                         FakeStage::kBallRadius;
      if (!(gap >= *expected.fromBall - 1e-3))
        fail(step, robot->name + format(" is %.3f m from the ball", gap));
    }
    const bool inOwnHalf = -game_.directionOf(robot->team) * pose.x >= robot->radius - 1e-3;
    if (expected.isInOwnHalf && *expected.isInOwnHalf != inOwnHalf)
      fail(step, robot->name + format(" is at x %.3f", pose.x));
  }

  void checkEvents(const Step& step, const Expectation& e) {
    const auto has = [this](const std::string& wanted) {
      return std::any_of(events_.begin(), events_.end(), [&](const RefereeEvent& event) {
        return wanted == event.what || wanted == event.what + " " + event.team;
      });
    };
    std::string all;
    for (const RefereeEvent& event : events_)
      all += "\n      " + event.what + " " + event.team + ": " + event.text;
    for (const std::string& wanted : e.seen)
      if (!has(wanted)) fail(step, "there was no event '" + wanted + "'; there were" + all);
    for (const std::string& unwanted : e.unseen)
      if (has(unwanted)) fail(step, "there was an event '" + unwanted + "'; there were" + all);
  }

  const Scenario& scenario_;
  FakeStage stage_;
  std::unique_ptr<Referee> referee_;
  Game game_;
  std::vector<RefereeEvent> events_;  ///< since the step before
  std::vector<std::string> problems_;
};

}  // namespace

std::vector<std::string> play(const Scenario& scenario) { return Run(scenario).play(); }

}  // namespace ortung::test

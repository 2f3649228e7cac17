// The model learner (paper, section 5.2): moves its robot over all poses of the field, where all
// features that localize learn their readings; writes the tables, and ends.
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>

#include "ortung/core/Plugin.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/TableLearner.hpp"

namespace ortung {
namespace {

/// Reads the player's options, but the file that it writes.
TableLearner::Settings settingsOf(const Parameters& p) {
  TableLearner::Settings settings;
  settings.cell = p.numberOr("cell_m", settings.cell, {1e-3, 10.0});
  settings.headingStepDeg = p.numberOr("heading_step_deg", settings.headingStepDeg, {1e-3, 360.0});
  settings.area = p.textOr("area", settings.area);
  settings.threads = static_cast<unsigned>(p.integerOr("threads", 1, {1, 256}));
  try {
    settings.check();
  } catch (const std::invalid_argument&) {
    p.fail("heading_step_deg", "expected degrees that divide a turn, e.g. 1, 2 or 2.5");
  }
  return settings;
}

class LearnerPlayer : public Player {
 public:
  explicit LearnerPlayer(const Parameters& p) : out_(p.text("out")), settings_(settingsOf(p)) {}

  bool needsStage() const override { return true; }

  void begin(PlayerSeat& seat) override {
    const Simulation* simulation = simulationOf(*seat.stage());
    if (simulation == nullptr) throw std::runtime_error("learns in a simulation only");
    const auto robots = simulation->robots();
    const auto own = std::find_if(robots.begin(), robots.end(), [&](const auto& one) {
      return one->config().name == seat.name();
    });
    if (own == robots.end()) throw std::runtime_error("its robot is not there");
    // A copy of the world, without moving bodies and other robots.
    learner_ =
        std::make_unique<TableLearner>(simulation->world().another(), (*own)->config(), settings_);
    if (learner_->leftOut() > 0.0) {
      char text[32];
      std::snprintf(text, sizeof text, "leaves out %.1f m^2", learner_->leftOut());
      seat.say(text);
    }
    for (const Learner::Need& need : learner_->learner().needs())
      seat.say("needs " + std::to_string(need.headings) + " headings for " + toText(need.feature));
  }

  /// Reports the progress. A thread of its own learns, so that neither other players nor the clock
  /// wait for it, and a sensor that hangs is noticed.
  bool senseAndAct(PlayerSeat& seat) override {
    if (!work_.joinable())
      work_ = std::jthread([this](const std::stop_token& stop) { learn(stop); });
    constexpr std::chrono::milliseconds kPatience{5};
    State state;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, kPatience, [&] { return state_.isOver; });
      state = state_;
    }
    if (state.failure) std::rethrow_exception(state.failure);
    tell(seat, state.share);
    if (!state.isOver) {
      show(seat, state.pose);
      return true;
    }
    save(seat);
    return false;
  }

 private:
  /// The progress of the thread.
  struct State {
    double share = 0.0;
    Pose2 pose;
    bool isOver = false;
    std::exception_ptr failure;
  };

  void learn(const std::stop_token& stop) {
    State state;
    while (!stop.stop_requested() && !state.isOver) {
      try {
        Learner& learner = learner_->learner();
        state.isOver = !learner.step();
        state.share = learner.share();
        state.pose = learner.pose();
      } catch (...) {
        state.failure = std::current_exception();
        state.isOver = true;
      }
      const std::lock_guard lock(mutex_);
      state_ = state;
    }
    changed_.notify_all();
  }

  /// Sends the progress to its team.
  void tell(PlayerSeat& seat, double share) {
    const auto part = static_cast<int>(1000.0 * share);
    if (part == told_) return;
    told_ = part;
    char text[32];
    std::snprintf(text, sizeof text, "learned %.1f %%", part / 10.0);
    seat.say(text);
  }

  /// Places its robot at the pose that is being learned, if there is room.
  static void show(PlayerSeat& seat, const Pose2& pose) {
    try {
      seat.stage()->placeRobot(seat.name(), pose);
    } catch (const std::invalid_argument&) {
      return;  // a sensor may be where its robot can't be
    }
  }

  void save(PlayerSeat& seat) {
    const std::uintmax_t bytes = learner_->write(out_);
    const FieldRegion& region = learner_->region();
    const auto count = [](const std::vector<std::uint8_t>& mask) {
      return std::to_string(std::count_if(mask.begin(), mask.end(), [](auto m) { return m != 0; }));
    };
    seat.say("wrote " + std::to_string(bytes) +
             " bytes: " + std::to_string(learner_->learner().needs().size()) + " features, " +
             std::to_string(region.grid.columns) + " x " + std::to_string(region.grid.rows) +
             " cells, " + count(region.open) + " open, " + count(region.standable) + " standable");
  }

  std::filesystem::path out_;
  TableLearner::Settings settings_;
  std::unique_ptr<TableLearner> learner_;
  int told_ = -1;
  std::mutex mutex_;  ///< guards state_
  std::condition_variable changed_;
  State state_;
  std::jthread work_;  ///< last member, since it uses the others
};

struct LearnerHelp : PlayerHelp {
  explicit LearnerHelp(const Parameters&)
      : PlayerHelp(
            "learns the readings of its robot's sensors at all poses, and writes the tables",
            {{"out", "file", "", "the table file; must be given"},
             {"cell_m", "m", "0.1", "edge of a cell"},
             {"heading_step_deg", "deg", "2", "angle between headings; divides a turn"},
             {"area", "auto|all|x;y", "auto",
              "part of the floor to learn: the main one, all of it, or the one around a point"},
             {"threads", "", "1", "number of threads; the tables do not depend on it"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("learner", ortung::provide<ortung::Player, ortung::LearnerPlayer>("learner"),
               ortung::provide<ortung::PlayerHelp, ortung::LearnerHelp>("learner"));

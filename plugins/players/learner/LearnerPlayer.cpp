// The model learner (paper, section 5.2): moves its robot over all poses of the field, where all
// features that localize learn their readings; writes the tables, and ends.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <list>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung {
namespace {

struct Settings {
  std::filesystem::path out;
  double cell = 0.1;          ///< edge length of a cell [m]
  double headingStep = 0.0;   ///< angle between headings [rad]
  std::string area = "auto";  ///< "auto", "all", or x and y with a semicolon between them [m]
  int threads = 1;

  explicit Settings(const Parameters& p) {
    out = p.text("out");
    cell = p.numberOr("cell_m", cell, {1e-3, 10.0});
    const double steps = 360.0 / p.numberOr("heading_step_deg", 2.0, {1e-3, 360.0});
    if (std::abs(steps - std::round(steps)) > 1e-6)
      p.fail("heading_step_deg", "expected degrees that divide a turn, e.g. 1, 2 or 2.5");
    headingStep = kTurn / std::round(steps);
    area = p.textOr("area", area);
    threads = static_cast<int>(p.integerOr("threads", 1, {1, 256}));
  }
};

class LearnerPlayer : public Player {
 public:
  explicit LearnerPlayer(const Parameters& p) : settings_(p) {}

  bool needsStage() const override { return true; }

  void begin(PlayerSeat& seat) override {
    const Simulation* simulation = simulationOf(*seat.stage());
    if (simulation == nullptr) throw std::runtime_error("learns in a simulation only");
    const auto robots = simulation->robots();
    const auto own = std::find_if(robots.begin(), robots.end(), [&](const auto& one) {
      return one->config().name == seat.name();
    });
    if (own == robots.end()) throw std::runtime_error("its robot is not there");
    robot_ = (*own)->config();
    world_ = simulation->world().another();  // a copy without moving bodies and other robots
    region_ = region(seat);
    for (int i = 0; i < (settings_.threads > 1 ? settings_.threads + 1 : 1); ++i) {
      containers_.emplace_back();
      devices_.push_back(fillContainer(containers_.back(), robot_, factory_));
    }
    learner_ = std::make_unique<Learner>(*world_, region_, devices_.front(),
                                         std::span(devices_).subspan(1), factory_, options());
    for (const Learner::Need& need : learner_->needs())
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

  LearnOptions options() const { return {settings_.cell, settings_.headingStep}; }

  void learn(const std::stop_token& stop) {
    State state;
    while (!stop.stop_requested() && !state.isOver) {
      try {
        state.isOver = !learner_->step();
        state.share = learner_->share();
        state.pose = learner_->pose();
      } catch (...) {
        state.failure = std::current_exception();
        state.isOver = true;
      }
      const std::lock_guard lock(mutex_);
      state_ = state;
    }
    changed_.notify_all();
  }

  FieldRegion region(PlayerSeat& seat) const {
    LearnArea area = learnAreaOf(*world_, settings_.cell, sizeOf(robot_), settings_.area);
    if (area.leftOut > 0.0) {
      char text[32];
      std::snprintf(text, sizeof text, "leaves out %.1f m^2", area.leftOut);
      seat.say(text);
    }
    return std::move(area.region);
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
    const TableInfo info = tableInfoOf(*world_, robot_, region_, options());
    const std::uintmax_t bytes = writeTables(settings_.out, containers_.front(), info);
    const auto count = [](const std::vector<std::uint8_t>& mask) {
      return std::to_string(std::count_if(mask.begin(), mask.end(), [](auto m) { return m != 0; }));
    };
    seat.say("wrote " + std::to_string(bytes) +
             " bytes: " + std::to_string(learner_->needs().size()) + " features, " +
             std::to_string(region_.grid.columns) + " x " + std::to_string(region_.grid.rows) +
             " cells, " + count(region_.open) + " open, " + count(region_.standable) +
             " standable");
  }

  Settings settings_;
  PluginFactory factory_{PluginFactory::standardFolders()};
  RobotConfig robot_;
  std::unique_ptr<SimWorld> world_;
  FieldRegion region_;
  std::list<SensorContainer> containers_;  ///< containers of all rigs; the first one learns
  std::vector<std::vector<Device>> devices_;
  std::unique_ptr<Learner> learner_;
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

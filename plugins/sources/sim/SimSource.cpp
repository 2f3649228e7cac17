#include <algorithm>
#include <stdexcept>

#include "ortung/core/Plugin.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/SceneRun.hpp"
#include "ortung/sim/SimulatedRun.hpp"

namespace ortung {
namespace {

/// The source "sim": the readings of a robot in a scripted scene, or alone in a world.
class SimSource : public Source {
 public:
  explicit SimSource(const Parameters& p)
      : options_(SimulatedRun::read(p)),
        factory_(PluginFactory::standardFolders()),
        run_(options_.scene, options_.config, factory_),
        fingerprint_(run_.simulation().world().fingerprint()) {
    if (!options_.robot.empty()) {
      const auto found = run_.find(options_.robot);
      if (!found) p.fail("robot", "is \"" + options_.robot + "\", which is not in the scene");
      robot_ = *found;
    } else if (run_.simulation().robots().empty()) {
      p.fail("path", "is a scene without robots");
    }
    if (options_.hasPictures) run_.simulation().robots()[robot_]->setWanted({}, true);
    for (const SceneRobot& robot : options_.scene.robots)
      if (robot.name == options_.robot) robotToml_ = readTomlText(robot.file);
  }
  ~SimSource() override = default;

  bool next(Message& message) override {
    while (sent_ == frame_.size()) {
      stopAtProblem();
      if (now() > options_.duration) return false;
      run_.step();
      frame_ = run_.simulation().readings(robot_);
      sent_ = 0;
    }
    message = frame_[sent_++];
    return true;
  }

  double progress() const override {
    const Timestamp duration = std::max(options_.duration, Timestamp{1});
    return std::min(toSeconds(now()) / toSeconds(duration), 1.0);
  }
  std::string worldFingerprint() const override { return fingerprint_; }
  std::string robotToml() const override { return robotToml_; }

 private:
  Timestamp now() const { return run_.simulation().now(); }
  /// Throws if a plugin has failed: readings without its features would look like those of another
  /// robot.
  void stopAtProblem() const {
    for (const auto& robot : run_.simulation().robots())
      if (!robot->problems().empty()) throw std::runtime_error(robot->problems().front());
  }

  SimulatedRun options_;
  PluginFactory factory_;
  SceneRun run_;
  std::string fingerprint_;
  std::string robotToml_;
  std::size_t robot_ = 0;
  std::span<const Message> frame_;
  std::size_t sent_ = 0;
};

/// The text of `ortung import sim --help`.
class SimHelp : public SourceHelp {
 public:
  explicit SimHelp(const Parameters&)
      : SourceHelp("world or scene (needs --with-robot for a world)",
                   {{"duration", "s", "60, or the scene's", "time of the last readings"},
                    {"seed", "", "1", "seed of noise, start and path"},
                    {"cycle_ms", "ms", "the world's", "time between two steps of the simulation"},
                    {"noise", "", "on", "off: sensors and odometry are exact"},
                    {"start", "m, m, deg", "at random", "x,y,theta; not with a scene"},
                    {"waypoints", "m", "wanders about",
                     "x,y;x,y;...: goes straight from one to the next; not with a scene"},
                    {"speed", "m/s", "the drive's",
                     "greatest speed; 0: it does not move; not with a scene"},
                    {"kidnap", "s", "never",
                     "t,t,...: times at which the robot is kidnapped; not with a scene"},
                    {"robot", "", "the first", "name of the robot in a scene"},
                    {"pictures", "", "off",
                     "on: cameras draw although no feature is made of their pictures"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("sim_source", ortung::provide<ortung::Source, ortung::SimSource>("sim"),
               ortung::provide<ortung::SourceHelp, ortung::SimHelp>("sim"));

#include "Settings.hpp"

#include <cmath>
#include <string>

#include "ortung/base/Parameters.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung::learning {
namespace {

Task taskOf(const std::string& id) {
  if (id == "goalkeeper-v0") return Task::kKeep;
  if (id == "striker-v0") return Task::kStrike;
  return id == "keeper-vs-striker-v0" ? Task::kBoth : Task::kLocalize;
}

Sight readSight(const Parameters& p, Task task) {
  if (task == Task::kLocalize)
    return p.choiceOr("observation", "localized", {"localized", "features"}) == "features"
               ? Sight::kFeatures
               : Sight::kLocalized;
  return p.choiceOr("observation", "features", {"features", "truth"}) == "truth" ? Sight::kTruth
                                                                                 : Sight::kFeatures;
}

}  // namespace

Settings Settings::read(const EnvironmentInfo& environment, const Options& options) {
  Parameters p("options of the environment " + environment.id);
  for (const auto& [key, value] : options) p.set(key, value);
  Settings s;
  s.task = taskOf(environment.id);
  s.sight = readSight(p, s.task);
  s.keeperRobot = "goalkeeper.toml";
  s.strikerRobot = s.task == Task::kLocalize ? "striker_lrf.toml" : "striker.toml";
  if (s.task == Task::kKeep) s.striker = strikerText(p.textOr("striker", "yardstick-v1"));
  if (s.task == Task::kStrike) s.keeper = keeperText(p.textOr("keeper", "blocking"));
  if (s.task == Task::kLocalize) {
    s.keeper = keeperText(p.textOr("keeper", "still"));
    s.startsAnywhere = p.choiceOr("start", "near", {"near", "anywhere"}) == "anywhere";
  }
  if (s.keeperIsAgent()) s.keeperSpeed = p.numberOr("keeper_speed_m_s", s.keeperSpeed, {0.1, 3.5});
  if (s.strikerIsAgent())
    s.strikerSpeed = p.numberOr("striker_speed_m_s", s.strikerSpeed, {0.1, 3.5});
  const auto cycle = p.integerOr("cycle_ms", 20, {5, 20});
  const double action = p.numberOr("action_s", 0.1, {0.005, 1.0});
  const double longest =
      p.numberOr("duration_s", s.task == Task::kLocalize ? 20.0 : 10.0, {1, 120});
  s.cycle = 1e-3 * static_cast<double>(cycle);
  s.cycles = static_cast<int>(std::lround(action / s.cycle));
  if (s.cycles < 1 || std::abs(s.cycles * s.cycle - action) > 1e-9)
    p.fail("action_s", "is " + std::to_string(action) + " s, expected a multiple of cycle_ms (" +
                           std::to_string(cycle) + " ms)");
  s.steps = static_cast<int>(std::ceil(longest / action - 1e-9));
  p.refuseUnread();
  return s;
}

}  // namespace ortung::learning

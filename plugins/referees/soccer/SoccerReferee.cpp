#include <algorithm>
#include <filesystem>

#include "Match.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung::soccer {
namespace {

/// Reads the name of a team, which must be a word.
std::string teamOf(const Parameters& p, const char* key, const char* fallback) {
  constexpr std::size_t kLongest = 64;
  const std::string name = p.textOr(key, fallback);
  const bool isWord =
      !name.empty() && name.size() <= kLongest &&
      std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; });
  if (!isWord) p.fail(key, "is '" + name + "', expected a word of at most 64 ASCII characters");
  return name;
}

Match::Config configOf(const Parameters& p) {
  Match::Config config;
  const std::string league = p.choiceOr("league", "f2000", {"f2000", "msl"});
  if (p.has("rules")) {
    if (p.has("league"))
      p.fail("league", "is given beside rules, which names a file; expected one of the two");
    const std::string rules = p.text("rules");
    const bool isFile = rules.ends_with(".toml") || rules.find('/') != rules.npos;
    config.rules = readRules(isFile ? std::filesystem::path(rules) : shippedRules(rules));
  } else {
    config.rules = readRules(shippedRules(league));
  }
  config.teams = {teamOf(p, "team_1", "blue"), teamOf(p, "team_2", "yellow")};
  if (config.teams[0] == config.teams[1])
    p.fail("team_2", "is '" + config.teams[1] + "', as team_1 is");
  const std::vector<std::string> teams(config.teams.begin(), config.teams.end());
  const auto placeOf = [&](const char* key) {
    return p.choiceOr(key, teams[0], teams) == teams[0] ? std::size_t{0} : std::size_t{1};
  };
  config.kickOff = placeOf("kick_off");
  config.left = placeOf("left");
  config.matches = static_cast<int>(p.integerOr("matches", 1, {0.0, 1e6}));
  config.control = p.choiceOr("control", "rules", {"rules", "orders"}) == "rules"
                       ? Control::kRules
                       : Control::kOrders;
  return config;
}

}  // namespace

/// The referee plugin: a Match made from options.
class SoccerReferee final : public Referee {
 public:
  explicit SoccerReferee(const Parameters& p) : match_(configOf(p)) {}
  ~SoccerReferee() override = default;

  const Game& watch(Stage& stage) override { return match_.watch(stage); }
  std::vector<RefereeEvent> takeEvents() override { return match_.takeEvents(); }
  bool holds(std::string_view robot) const override { return match_.holds(robot); }
  void order(std::string_view order) override { match_.order(order); }

 private:
  Match match_;
};

}  // namespace ortung::soccer

ORTUNG_PLUGINS("soccer_referee",
               ortung::provide<ortung::Referee, ortung::soccer::SoccerReferee>("soccer"));

#include "ortung/sim/PlayerWish.hpp"

#include <set>
#include <string_view>
#include <utility>

#include "ortung/base/Angles.hpp"
#include "ortung/core/SourceOptions.hpp"

namespace ortung {
namespace {

/// Sets a plugin's option from the text of its value.
void setOption(Parameters& options, const std::string& key, const std::string& text) {
  const auto numbers = parseNumbers(text);
  if (text == "yes" || text == "no") {
    options.set(key, text == "yes");
  } else if (numbers && numbers->size() == 1) {
    options.set(key, numbers->front());
  } else if (numbers) {
    options.set(key, *numbers);
  } else {
    options.set(key, text);
  }
}

/// Cuts @p text at the first @p mark. @returns the text behind it; nothing if there is no mark
std::optional<std::string_view> cut(std::string_view& text, char mark) {
  const std::size_t place = text.find(mark);
  if (place == std::string_view::npos) return std::nullopt;
  const std::string_view rest = text.substr(place + 1);
  text = text.substr(0, place);
  return rest;
}

bool isTeam(const std::string& name) {
  return !name.empty() && name.size() <= 32 &&
         name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
             std::string::npos;
}

/// @param kind "player" or "referee", for error messages
PlayerWish parse(const std::string& kind, const std::string& text) {
  const std::string where = kind + " '" + text + "'";
  const auto refuse = [&](const std::string& why) {
    throw ConfigError(where + ": " + why + ", expected PLUGIN[:key=value&key=value...][@TEAM]");
  };
  std::string_view rest = text;
  PlayerWish wish;
  // A team is a word, so an "@" in a file's name does not begin one.
  const std::size_t at = rest.rfind('@');
  if (at != std::string_view::npos) {
    wish.team = rest.substr(at + 1);
    if (!isTeam(wish.team)) refuse("'" + wish.team + "' is not the name of a team");
    rest = rest.substr(0, at);
  }
  std::optional<std::string_view> options = cut(rest, ':');
  wish.plugin = rest;
  if (wish.plugin.empty()) refuse("it names no plugin");
  wish.options = Parameters(where);
  Parameters own(where);
  std::set<std::string> given;
  while (options && !options->empty()) {
    std::string_view option = *options;
    options = cut(option, '&');
    const auto value = cut(option, '=');
    const std::string key(option);
    if (!value || key.empty()) refuse("'" + key + "' is not key=value");
    const bool isOwn =
        key == "robot" || key == "tables" || key == "name" || key == "start" || key == "stage";
    if (!given.insert(key).second) refuse(key + " is given twice");
    if (isOwn && value->empty()) refuse(key + " is empty");
    if (isOwn)
      own.set(key, std::string(*value));
    else
      setOption(wish.options, key, std::string(*value));
  }
  wish.robot = own.textOr("robot", "");
  wish.tables = own.textOr("tables", "");
  wish.name = own.textOr("name", "");
  wish.start = optionPose(own, "start");
  wish.seesStage = own.choiceOr("stage", "yes", {"yes", "no"}) == "yes";
  return wish;
}

}  // namespace

PlayerWish parsePlayer(const std::string& text) { return parse("player", text); }

RefereeWish parseReferee(const std::string& text) {
  const PlayerWish wish = parse("referee", text);
  if (!wish.team.empty() || !wish.name.empty() || !wish.robot.empty() || wish.start)
    throw ConfigError("referee '" + text + "': has no team, name, robot and start");
  return {wish.plugin, wish.options};
}

PlayerWish readPlayer(const Parameters& table, const std::filesystem::path& folder) {
  PlayerWish wish;
  wish.plugin = table.text("plugin");
  wish.team = table.textOr("team", "");
  if (!wish.team.empty() && !isTeam(wish.team))
    table.fail("team", "is \"" + wish.team + "\", expected a word of at most 32 letters");
  wish.name = table.textOr("name", "");
  for (const char* key : {"name", "team", "robot", "tables"})
    if (table.has(key) && table.text(key).empty()) table.fail(key, "is empty; leave it out");
  for (const auto& [key, file] : {std::pair{"robot", &wish.robot}, {"tables", &wish.tables}}) {
    const std::string name = table.textOr(key, "");
    if (name.find('\0') != std::string::npos) table.fail(key, "names no file");
    if (!name.empty()) *file = folder / name;
  }
  if (table.has("start")) {
    const Parameters start = table.table("start");
    wish.start = Pose2{start.number("x_m", {-1e4, 1e4}), start.number("y_m", {-1e4, 1e4}),
                       wrapAngle(radians(start.numberOr("theta_deg", 0.0, {-3600.0, 3600.0})))};
    start.refuseUnread();
  }
  wish.seesStage = table.flagOr("stage", true);
  wish.options = table.takeTable("options");  // they are checked by the plugin
  table.refuseUnread();
  return wish;
}

}  // namespace ortung

#include "ortung/refbox/BoxCommand.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace ortung::refbox {
namespace {

constexpr std::size_t kLongestWord = 64;  ///< characters of a command or an address
constexpr std::int64_t kMostRobots = 99;

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string result(text.substr(0, kMost));
  std::replace_if(result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + result + (text.size() > kMost ? "...'" : "'");
}

/// A text of the message, or nothing.
std::optional<std::string> textOf(const nlohmann::json& json, const char* key, std::string& why) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) {
    why = std::string(key) + (found == json.end() ? " is missing" : " is no text");
    return std::nullopt;
  }
  const auto& text = found->get_ref<const std::string&>();
  if (text.size() > kLongestWord) {
    why = std::string(key) + " is longer than " + std::to_string(kLongestWord) + " characters";
    return std::nullopt;
  }
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  return begin == text.size() ? "" : text.substr(begin, end - begin + 1);
}

/// A command and the order that it is.
struct Meaning {
  std::string_view command;
  std::string_view order;  ///< the referee's order; "": nothing to do
  bool isOfTeam = false;
};

constexpr std::array kMeanings = {
    Meaning{"START", "start"},
    Meaning{"STOP", "stop"},
    Meaning{"DROP_BALL", "dropped-ball"},
    Meaning{"HALF_TIME", "half-time"},
    Meaning{"END_PART", "half-time"},
    Meaning{"END_GAME", "end"},
    Meaning{"GAMEOVER", "end"},
    Meaning{"GAME_OVER", "end"},
    Meaning{"PARK", "stop"},
    Meaning{"FIRST_HALF", "first-half"},
    Meaning{"SECOND_HALF", "second-half"},
    Meaning{"FIRST_HALF_OVERTIME", "first-overtime"},
    Meaning{"SECOND_HALF_OVERTIME", "second-overtime"},
    Meaning{"RESET", "reset"},
    Meaning{"TESTMODE_ON", ""},
    Meaning{"TESTMODE_OFF", ""},
    Meaning{"WELCOME", ""},
    Meaning{"IS_ALIVE", ""},
    Meaning{"KICKOFF", "kick-off", true},
    Meaning{"FREEKICK", "free-kick", true},
    Meaning{"GOALKICK", "goal-kick", true},
    Meaning{"THROWIN", "throw-in", true},
    Meaning{"CORNER", "corner", true},
    Meaning{"PENALTY", "penalty", true},
    Meaning{"GOAL", "goal", true},
    Meaning{"SUBGOAL", "no-goal", true},
    Meaning{"REPAIR", "repair", true},
    Meaning{"REPAIR_END", "repair-end", true},
    Meaning{"YELLOW_CARD", "yellow-card", true},
    Meaning{"DOUBLE_YELLOW", "red-card", true},
    Meaning{"RED_CARD", "red-card", true},
    Meaning{"SUBSTITUTION", "substitution", true},
};

}  // namespace

std::optional<BoxCommand> readBoxCommand(std::string_view message, std::string& why) {
  const auto json = nlohmann::json::parse(message.begin(), message.end(), nullptr, false);
  if (!json.is_object()) {
    why = json.is_discarded() ? "it is no JSON" : "it is no JSON object";
    why += ": " + shown(message);
    return std::nullopt;
  }
  const auto command = textOf(json, "command", why);
  if (!command) return std::nullopt;
  BoxCommand result{trimmed(*command), "", std::nullopt};
  if (json.contains("targetTeam")) {  // some boxes leave it out where it is for both
    const auto team = textOf(json, "targetTeam", why);
    if (!team) return std::nullopt;
    result.targetTeam = trimmed(*team);
  }
  if (const auto robot = json.find("robotID"); robot != json.end() && !robot->is_null()) {
    const bool isNumber = robot->is_number_integer() && *robot >= 0 && *robot <= kMostRobots;
    if (!isNumber) {
      why = "robotID is no whole number from 0 to " + std::to_string(kMostRobots);
      return std::nullopt;
    }
    result.robot = robot->get<std::int64_t>();
  }
  return result;
}

std::optional<std::string> orderOf(const BoxCommand& command, const BoxTeams& teams,
                                   std::string& why) {
  const auto meaning = std::find_if(kMeanings.begin(), kMeanings.end(),
                                    [&](const Meaning& m) { return m.command == command.command; });
  if (meaning == kMeanings.end()) {
    why = "the command " + shown(command.command) + " is not known";
    return std::nullopt;
  }
  if (!meaning->isOfTeam) return std::string(meaning->order);
  if (command.targetTeam.empty() || teams.address.empty()) {
    why = command.command + (command.targetTeam.empty()
                                 ? " names no team"
                                 : " came before the box has said which team this is");
    return std::nullopt;
  }
  const bool isOwn = command.targetTeam == teams.address;
  return std::string(meaning->order) + " " + (isOwn ? teams.own : teams.other);
}

}  // namespace ortung::refbox

#include "Orders.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace ortung::soccer {
namespace {

constexpr std::size_t kLongest = 200;

struct Known {
  std::string_view word;
  Order::Kind kind;
  bool hasTeam;
  int half = 0;
  bool isOvertime = false;
};

constexpr std::array kKnown = {
    Known{"start", Order::Kind::kStart, false},
    Known{"stop", Order::Kind::kStop, false},
    Known{"kick-off", Order::Kind::kRestart, true},
    Known{"throw-in", Order::Kind::kRestart, true},
    Known{"goal-kick", Order::Kind::kRestart, true},
    Known{"corner", Order::Kind::kRestart, true},
    Known{"free-kick", Order::Kind::kRestart, true},
    Known{"penalty", Order::Kind::kRestart, true},
    Known{"dropped-ball", Order::Kind::kRestart, false},
    Known{"goal", Order::Kind::kGoal, true},
    Known{"no-goal", Order::Kind::kNoGoal, true},
    Known{"half-time", Order::Kind::kHalfTime, false},
    Known{"first-half", Order::Kind::kBeginHalf, false, 1},
    Known{"second-half", Order::Kind::kBeginHalf, false, 2},
    Known{"first-overtime", Order::Kind::kBeginHalf, false, 1, true},
    Known{"second-overtime", Order::Kind::kBeginHalf, false, 2, true},
    Known{"end", Order::Kind::kEnd, false},
    Known{"reset", Order::Kind::kReset, false},
    Known{"yellow-card", Order::Kind::kNote, true},
    Known{"red-card", Order::Kind::kNote, true},
    Known{"repair", Order::Kind::kNote, true},
    Known{"repair-end", Order::Kind::kNote, true},
    Known{"substitution", Order::Kind::kNote, true},
};

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  std::string shown(text.substr(0, kLongest));
  std::replace_if(shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  std::string orders;
  for (const Known& known : kKnown) {
    orders += (orders.empty() ? "" : ", ") + std::string(known.word);
    if (known.hasTeam) orders += " TEAM";
  }
  throw std::invalid_argument("the order '" + shown + "' " + why + "; there are " + orders);
}

std::string_view takeWord(std::string_view& rest) {
  const std::size_t begin = std::min(rest.find_first_not_of(' '), rest.size());
  rest.remove_prefix(begin);
  const std::size_t end = std::min(rest.find(' '), rest.size());
  const std::string_view word = rest.substr(0, end);
  rest.remove_prefix(end);
  return word;
}

}  // namespace

Order orderOf(std::string_view text, const Game& game) {
  std::string_view rest = text;
  const std::string_view word = takeWord(rest);
  const auto known =
      std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& k) { return k.word == word; });
  if (known == kKnown.end()) refuse(text, word.empty() ? "is empty" : "is unknown");
  Order order;
  order.kind = known->kind;
  order.half = known->half;
  order.isOvertime = known->isOvertime;
  order.text = word;
  if (known->kind == Order::Kind::kRestart) order.restart = *restartOf(word);
  if (known->hasTeam) {
    const std::string_view team = takeWord(rest);
    order.team = game.find(team);
    if (!order.team)
      refuse(text, (team.empty() ? "lacks a team" : "names a team that does not play") +
                       std::string("; teams are ") + game.teams[0].name + " and " +
                       game.teams[1].name);
  }
  if (!takeWord(rest).empty()) refuse(text, "has a word too many");
  return order;
}

}  // namespace ortung::soccer

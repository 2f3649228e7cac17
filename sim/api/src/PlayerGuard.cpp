#include "ortung/sim_api/PlayerGuard.hpp"

#include <time.h>

#include <algorithm>
#include <stdexcept>

namespace ortung {
namespace {

constexpr std::size_t kMostText = 400;

}  // namespace

PlayerGuard::PlayerGuard(const std::string& plugin, const std::string& robot, double budget)
    : who_("the player '" + plugin + "' of robot " + robot), budget_(budget), guard_(who_) {}

PlayerGuard::~PlayerGuard() = default;

/// Returns the processor time that this thread has used [s].
double PlayerGuard::processorTime() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::string PlayerGuard::overdue(const char* what, double taken) const {
  if (taken <= budget_) return "";
  return who_ + ": " + what + "() took " + std::to_string(taken) +
         " s of processor time, expected at most " + std::to_string(budget_) + " s";
}

PlayerNeeds needsOf(const Player& player, const std::string& plugin) {
  constexpr double kLongest = 1e6;  // [s]
  const PluginGuard guard("the player '" + plugin + "'");
  PlayerNeeds needs;
  guard("robotFile", [&] { needs.robotFile = player.robotFile(); });
  guard("needsStage", [&] { needs.stage = player.needsStage(); });
  guard("needsTables", [&] { needs.tables = player.needsTables(); });
  guard("needsPictures", [&] { needs.pictures = player.needsPictures(); });
  guard("period", [&] { needs.period = player.period(); });
  if (!(needs.period >= 0.0 && needs.period <= kLongest))
    guard.fail("period", "is " + std::to_string(needs.period) + ", must be in [0, 1e6] s");
  return needs;
}

void checkSaid(std::string_view text) {
  if (text.size() > kMostText)
    throw std::invalid_argument("has " + std::to_string(text.size()) +
                                " characters to say, expected at most " +
                                std::to_string(kMostText));
  if (std::any_of(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }))
    throw std::invalid_argument("sends a message that is not printable ASCII");
}

}  // namespace ortung

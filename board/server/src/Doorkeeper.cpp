#include "Doorkeeper.hpp"

#include <algorithm>

#include "ortung/server/ControlToken.hpp"

namespace ortung::server {
namespace {

constexpr Timestamp kMemory = 60'000'000;  // how long a wrong token is remembered [us]
constexpr std::size_t kMostPeers = 4096;   // peers remembered; with more, all have to wait
// Least time between two lines, so that guesses don't fill the disk [us]
constexpr Timestamp kLogPeriod = 1'000'000;

bool isRemembered(Timestamp since, Timestamp now) { return now - since < kMemory; }

}  // namespace

bool isSameInConstantTime(std::string_view secret, std::string_view given) {
  // volatile, so that no compiler ends the loop early.
  volatile unsigned char difference = secret.size() == given.size() ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const char expected = secret.empty() ? '\0' : secret[i % secret.size()];
    difference = static_cast<unsigned char>(difference | (expected ^ given[i]));
  }
  return difference == 0;
}

bool Doorkeeper::isReserved(std::string_view name) const {
  const auto& tokens = config_.tokens;
  const auto& control = config_.control;
  return std::any_of(tokens.begin(), tokens.end(),
                     [&](const BoardToken& token) { return token.name == name; }) ||
         std::find(control.begin(), control.end(), name) != control.end();
}

bool Doorkeeper::isRight(std::string_view name, std::string_view token) const {
  const bool isOpenToAll = !isReserved(name);
  const bool hasOwn = std::any_of(config_.tokens.begin(), config_.tokens.end(),
                                  [&](const BoardToken& known) { return known.name == name; });
  bool isRight = config_.tokens.empty() || (config_.guests && !hasOwn);
  for (const BoardToken& known : config_.tokens) {
    const bool isSame = isSameInConstantTime(known.token, token);
    const bool isMeant = known.name == name || (known.name == "*" && isOpenToAll);
    isRight = isRight || (isSame && isMeant && !known.token.empty());
  }
  return isRight;
}

bool Doorkeeper::mayControl(std::string_view name) const {
  const auto& control = config_.control;
  return std::any_of(control.begin(), control.end(),
                     [&](const std::string& who) { return who == "*" || who == name; });
}

Timestamp Doorkeeper::pause(const std::string& peer, Timestamp now) const {
  if (config_.tokens.empty()) return 0;
  const auto found = refused_.find(peer);
  const bool isSuspect = refused_.size() >= kMostPeers ||
                         (found != refused_.end() && isRemembered(found->second, now));
  return isSuspect ? fromSeconds(config_.limits.refusal) : 0;
}

void Doorkeeper::refuse(const std::string& peer, const std::string& name, Timestamp now) {
  std::erase_if(refused_, [&](const auto& entry) { return !isRemembered(entry.second, now); });
  if (refused_.size() < kMostPeers) refused_[peer] = now;
  if (!config_.log) return;
  if (logged_ != 0 && now - logged_ < kLogPeriod) {
    ++unlogged_;
    return;
  }
  config_.log(
      "a client at " + peer + " that calls itself '" + name + "' has a wrong token" +
      (unlogged_ > 0 ? "; so had " + std::to_string(unlogged_) + " more since the last note" : ""));
  logged_ = now;
  unlogged_ = 0;
}

}  // namespace ortung::server

bool ortung::isControlToken(const BoardConfig& config, std::string_view token) {
  bool isRight = false;
  for (const BoardToken& known : config.tokens) {
    const bool mayControl =
        std::find(config.control.begin(), config.control.end(), known.name) != config.control.end();
    const bool isSame = server::isSameInConstantTime(known.token, token);
    isRight = isRight || (isSame && mayControl && known.name != "*" && !known.token.empty());
  }
  return isRight;
}

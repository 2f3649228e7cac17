#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Time.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace ortung::server {

/// Whether both texts are the same, in a time that depends on the length of @p given alone.
bool isSameInConstantTime(std::string_view secret, std::string_view given);

/// Says who may come in, and makes guessing slow: after a wrong token from a computer its greetings
/// are looked at later for a while, however many connections it opens. Not thread-safe.
class Doorkeeper {
 public:
  /// @param config borrowed
  explicit Doorkeeper(const BoardConfig& config) : config_(config) {}

  /// Whether a client of this name may come in with this token; always, if there are no tokens. A
  /// name that has a token of its own, or may control, is never let in by the token of '*'.
  bool isRight(std::string_view name, std::string_view token) const;
  /// Whether @p name is one that may control the world.
  bool mayControl(std::string_view name) const;
  /// How long a greeting from @p peer has to wait before it is looked at [us].
  /// @param now on the computer's clock
  Timestamp pause(const std::string& peer, Timestamp now) const;
  /// Somebody there had a wrong token: remembers and logs that.
  void refuse(const std::string& peer, const std::string& name, Timestamp now);

 private:
  bool isReserved(std::string_view name) const;

  const BoardConfig& config_;
  std::map<std::string, Timestamp> refused_;  ///< time of the last refusal, by computer [us]
  Timestamp logged_ = 0;
  std::size_t unlogged_ = 0;  ///< refusals since then
};

}  // namespace ortung::server

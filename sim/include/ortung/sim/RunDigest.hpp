#pragma once

#include <cstdint>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/sim/SceneRun.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {

/// A digest of a run: FNV-1a over 64-bit words. Two runs of the same program with the same digest
/// are the same to the bit, whether they were watched or not. Not thread-safe.
class ORTUNG_API RunDigest {
 public:
  /// Adds a cycle; to be called once after each: poses and velocities, states of manipulators,
  /// readings and the state of the game.
  void add(const SceneRun& run);
  /// Adds an event of the referee.
  void add(const RefereeEvent& event);
  std::uint64_t value() const { return hash_; }

 private:
  void word(std::uint64_t word) { hash_ = (hash_ ^ word) * 1099511628211U; }
  void number(double number);
  void text(std::string_view text);
  void body(const Pose2& pose, const Twist& velocity);

  std::uint64_t hash_ = 14695981039346656037U;
};

}  // namespace ortung

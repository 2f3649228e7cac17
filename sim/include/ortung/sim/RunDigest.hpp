#pragma once

#include <cstdint>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/sim/SceneRun.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {

/// A hash of all that happens in a run: FNV-1a, a word at a time. Two runs of the same program with
/// the same digest have done the same to the bit, whatever they were watched with. Not thread-safe.
class ORTUNG_API RunDigest {
 public:
  /// Once after each cycle: where everything is and how it moves, what manipulators do, what was
  /// sensed, how the game stands.
  void add(const SceneRun& run);
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

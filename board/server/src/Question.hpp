#pragma once

#include <atomic>
#include <cstdint>

namespace ortung::server {

/// What a client has asked for and what waits for its turn: whoever works on it begins it, or the
/// client withdraws it for a newer one, whichever comes first. Thread-safe.
class Question {
 public:
  /// @returns false if it was withdrawn: then nothing is to be done, and nobody to be answered
  bool begin() { return leave(State::kBegun); }
  /// @returns false if it was begun: then it will be answered
  bool withdraw() { return leave(State::kWithdrawn); }
  bool isWithdrawn() const { return state_ == State::kWithdrawn; }

 private:
  enum class State : std::uint8_t { kWaiting, kBegun, kWithdrawn };
  bool leave(State next) {
    State waiting = State::kWaiting;
    return state_.compare_exchange_strong(waiting, next);
  }
  std::atomic<State> state_ = State::kWaiting;
};

}  // namespace ortung::server

#pragma once

#include <thread>

#include "ortung/server/MessageBoard.hpp"

namespace ortung::test {

/// The world goes on only when clients in lockstep ask for it.
inline BoardConfig lockstepConfig() {
  BoardConfig config;
  config.pace = Pace::kLockstep;
  return config;
}

/// The same, and every client may control it.
inline BoardConfig controlledConfig() {
  BoardConfig config = lockstepConfig();
  config.control = {"*"};
  return config;
}

/// Limits of time that a test does not set are long: a busy machine may hold up a client for
/// longer than a server waits for one.
inline BoardConfig patient(BoardConfig config) {
  constexpr double kLong = 600.0;  // [s]
  const BoardLimits usual;
  for (const auto limit :
       {&BoardLimits::handshake, &BoardLimits::head, &BoardLimits::idle, &BoardLimits::stall})
    if (config.limits.*limit == usual.*limit) config.limits.*limit = kLong;
  return config;
}

/// A board that serves a world on a port of the system's choice, on a thread of its own.
class RunningBoard {
 public:
  RunningBoard(ServedWorld& world, const BoardConfig& config)
      : board_(world, patient(config)), thread_([this] { board_.run(); }) {}
  ~RunningBoard() {
    board_.stop();
    thread_.join();
  }
  RunningBoard(const RunningBoard&) = delete;
  RunningBoard& operator=(const RunningBoard&) = delete;

  std::uint16_t port() const { return board_.port(); }
  BoardStatistics statistics() const { return board_.statistics(); }

 private:
  MessageBoard board_;
  std::thread thread_;
};

}  // namespace ortung::test

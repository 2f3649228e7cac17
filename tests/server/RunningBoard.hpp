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

/// A board that serves a world on a port of the system's choice, on a thread of its own.
class RunningBoard {
 public:
  RunningBoard(ServedWorld& world, const BoardConfig& config)
      : board_(world, config), thread_([this] { board_.run(); }) {}
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

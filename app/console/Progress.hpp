#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace ortung::app {

/// Shows the progress of long work on stderr: a bar on a terminal, else a line every few seconds.
/// Not thread-safe.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param work what is done, for the user
  /// @param bar whether to draw a bar even if stderr is not a terminal
  /// @param clock tells the time
  Progress(std::string work, bool bar, std::function<Clock::time_point()> clock = &Clock::now);
  ~Progress();  ///< ends the bar's line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param share share that is done, in [0, 1]; negative: unknown
  void update(double share);

 private:
  void drawBar(double share, double seconds);
  void writeLine(double share, double seconds) const;

  std::string work_;
  bool bar_;
  bool drawn_ = false;
  std::function<Clock::time_point()> clock_;
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace ortung::app

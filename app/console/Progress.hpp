#pragma once

#include <chrono>
#include <string>

namespace ortung::app {

/// Shows the progress of long work on stderr: a bar on a terminal, else a line every few seconds.
/// Not thread-safe.
class Progress {
 public:
  /// @param work what is done, for the user
  /// @param bar whether to draw a bar even if stderr is not a terminal
  Progress(std::string work, bool bar);
  ~Progress();  ///< ends the bar's line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param share share that is done, in [0, 1]; negative: unknown
  void update(double share);

 private:
  using Clock = std::chrono::steady_clock;
  void drawBar(double share, double seconds);
  void writeLine(double share, double seconds) const;

  std::string work_;
  bool bar_;
  bool drawn_ = false;
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace ortung::app

#include "Progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "Console.hpp"

namespace ortung::app {
namespace {

constexpr int kBarWidth = 40;
constexpr std::chrono::milliseconds kBetweenBars(100);
constexpr std::chrono::seconds kBetweenLines(5);

std::string timeLeft(double share, double seconds) {
  if (!(share > 0.0) || seconds < 1.0) return "";
  return fmt::format(", {:.0f} s left", std::ceil(seconds * (1.0 - share) / share));
}

/// Prints text. A closed terminal or a full disk must not end the work, so errors are ignored.
void show(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

Progress::Progress(std::string work, bool bar, std::function<Clock::time_point()> clock)
    : work_(std::move(work)),
      bar_(bar || isatty(STDERR_FILENO) == 1),
      clock_(std::move(clock)),
      start_(clock_()),
      next_(bar_ ? start_ : start_ + kBetweenLines) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\n", stderr);
}

void Progress::update(double share) {
  const Clock::time_point now = clock_();
  const bool atEnd = share >= 1.0 && drawn_;
  if (now < next_ && !atEnd) return;
  next_ = now + (bar_ ? Clock::duration(kBetweenBars) : Clock::duration(kBetweenLines));
  const double seconds = std::chrono::duration<double>(now - start_).count();
  if (bar_) {
    drawBar(std::min(share, 1.0), seconds);
  } else {
    writeLine(std::min(share, 1.0), seconds);
  }
}

void Progress::drawBar(double share, double seconds) {
  drawn_ = true;
  if (!(share >= 0.0)) {
    show(fmt::format("\r{} {:.0f} s\033[K", work_, seconds));
  } else {
    const int full = static_cast<int>(share * kBarWidth);
    show(fmt::format("\r{} [{:#<{}}{:.<{}}] {:3.0f} %{}\033[K", work_, "", full, "",
                     kBarWidth - full, 100.0 * share, timeLeft(share, seconds)));
  }
}

void Progress::writeLine(double share, double seconds) const {
  if (!(share >= 0.0)) {
    note(fmt::format("{}, {:.0f} s", work_, seconds));
  } else {
    note(fmt::format("{}: {:.0f} %{}", work_, 100.0 * share, timeLeft(share, seconds)));
  }
}

}  // namespace ortung::app

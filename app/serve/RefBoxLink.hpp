#pragma once

#include <functional>
#include <memory>
#include <string>

#include "ortung/sim/SceneRun.hpp"

namespace ortung::refbox {
class RefBoxClient;
}

namespace ortung::app {

/// Lets a RefBox of the Middle Size League lead a simulated game: its commands are orders to the
/// referee, and it is told where one team's robots and the ball are.
class RefBoxLink {
 public:
  /// The game that is under way, with a referee; it may be another one each time.
  using Run = std::function<SceneRun&()>;

  /// @param text "HOST[:PORT][@TEAM]" @throws UsageError for what is none
  RefBoxLink(const std::string& text, const Run& run);
  ~RefBoxLink();
  RefBoxLink(const RefBoxLink&) = delete;
  RefBoxLink& operator=(const RefBoxLink&) = delete;

  /// Does what is to be done, without waiting. @param seconds of a clock that only goes forwards
  void poll(double seconds);

 private:
  std::unique_ptr<refbox::RefBoxClient> client_;
};

}  // namespace ortung::app

#pragma once

#include <functional>
#include <memory>
#include <string>

#include "ortung/sim/SceneRun.hpp"

namespace ortung::refbox {
class RefBoxClient;
}

namespace ortung::app {

/// Lets a RefBox of the Middle Size League control a simulated game: its commands are orders to the
/// referee, and it gets the places of one team's robots and of the ball.
class RefBoxLink {
 public:
  /// Returns the current game, which has a referee; it may be another one each time.
  using Run = std::function<SceneRun&()>;

  /// @param text address and team, "HOST[:PORT][@TEAM]" @throws UsageError if it has another form
  RefBoxLink(const std::string& text, const Run& run);
  ~RefBoxLink();
  RefBoxLink(const RefBoxLink&) = delete;
  RefBoxLink& operator=(const RefBoxLink&) = delete;

  /// Exchanges what is due, without waiting. @param seconds time of a steady clock [s]
  void poll(double seconds);

 private:
  std::unique_ptr<refbox::RefBoxClient> client_;
};

}  // namespace ortung::app

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// One client of Foxglove's WebSocket protocol (subprotocols foxglove.websocket.v1 and
/// foxglove.sdk.v1), which is told of a message board's robots in messages of ROS 2: a pure
/// function of what both say, without sockets, clocks or threads. Channels are as
/// `ortung::ros2::RobotTopics` makes them; in a simulation, and where there are several, each
/// robot's have its name before them. A record can be played, paused and sought in
/// (PlaybackControl).
///
/// What it wants to be said it leaves in toBoard and toClient, from which its caller takes it.
/// Everything from the client is hostile; the board is our own. Not thread-safe.
class ORTUNG_API FoxgloveSession {
 public:
  struct Frame {
    std::string bytes;
    bool isBinary = true;
  };

  /// @param token for the board; "": it comes in as a viewer without one
  explicit FoxgloveSession(const std::string& token = "");
  ~FoxgloveSession();
  FoxgloveSession(const FoxgloveSession&) = delete;
  FoxgloveSession& operator=(const FoxgloveSession&) = delete;

  /// A whole message of the client.
  void fromClient(std::string_view message, bool isBinary);
  /// The next bytes that the board says, cut anywhere.
  void fromBoard(std::string_view bytes);

  std::string toBoard;          ///< not said yet
  std::vector<Frame> toClient;  ///< not said yet, in this order
  bool isOver = false;          ///< the connection is closed when all is said

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// The session of one client of Foxglove's WebSocket protocol (subprotocols foxglove.websocket.v1
/// and foxglove.sdk.v1), which gets the readings of a message board's robots as messages of ROS 2.
/// It is a pure function of the bytes of both sides, without sockets, clocks or threads. Channels
/// are the topics of `ortung::ros2::RobotTopics`; in a simulation, and if there are several robots,
/// their names begin with the robot's. A client can play, pause and seek in a record
/// (PlaybackControl).
///
/// Bytes to send are appended to toBoard and toClient, from which the caller takes them. The client
/// is not trusted; the board is. Not thread-safe.
class ORTUNG_API FoxgloveSession {
 public:
  /// A WebSocket message.
  struct Frame {
    std::string bytes;     ///< its content
    bool isBinary = true;  ///< whether it is binary, else text
  };

  /// Greets the board.
  /// @param token token for the board; "": none, the session is a viewer's
  explicit FoxgloveSession(const std::string& token = "");
  ~FoxgloveSession();
  FoxgloveSession(const FoxgloveSession&) = delete;
  FoxgloveSession& operator=(const FoxgloveSession&) = delete;

  /// Takes a whole message of the client.
  void fromClient(std::string_view message, bool isBinary);
  /// Takes the next bytes of the board, cut anywhere.
  void fromBoard(std::string_view bytes);

  std::string toBoard;          ///< bytes to send to the board
  std::vector<Frame> toClient;  ///< messages to send to the client, in this order
  bool isOver = false;          ///< whether to close the connection after all was sent

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// What is spoken over one WebSocket, and what of it becomes words of the message board: a function
/// of the bytes of both sides, without sockets or clocks. Calls come from one thread. What it wants
/// to be said it leaves in its two members, from which the door takes it; while one side does not
/// read, the other is not listened to, so neither grows.
class ORTUNG_API WebSpeech {
 public:
  struct Frame {
    std::string bytes;
    bool isBinary = true;
  };

  virtual ~WebSpeech();
  /// A whole message of the client, which is hostile.
  virtual void fromClient(std::string_view message, bool isBinary) = 0;
  /// The next bytes that the board says, cut anywhere.
  virtual void fromBoard(std::string_view bytes) = 0;

  std::string toBoard;          ///< bytes to be sent to the board
  std::vector<Frame> toClient;  ///< frames to be sent to the client, in this order
  bool isOver = false;          ///< the connection is closed when all is said
};

/// A subprotocol of WebSockets that the door lets in.
struct WebProtocol {
  /// Names in Sec-WebSocket-Protocol; of several the first one that the client gives is agreed
  /// upon.
  std::vector<std::string> names;
  std::string path;  ///< path of its requests, e.g. "/board"; "": any
  /// For each connection; may be called often. Gets the path and query that were asked for, which
  /// are hostile.
  std::function<std::unique_ptr<WebSpeech>(std::string_view target)> make;
};

/// The board's own words: a client's messages are bytes of its lines, and binary messages to it the
/// bytes that the board says, cut anywhere. At /board, "ortung.board.1".
ORTUNG_API WebProtocol boardProtocol();

}  // namespace ortung

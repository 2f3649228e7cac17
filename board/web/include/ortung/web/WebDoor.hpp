#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/web/WebSpeech.hpp"
#include "ortung/web/WebUpload.hpp"

namespace ortung {

/// What browsers may take, at most.
struct WebLimits {
  std::size_t head = 16u << 10;      ///< head of a request [bytes]
  std::size_t message = 128u << 10;  ///< a client's message over a WebSocket [bytes]
  std::size_t page = 16u << 20;      ///< all files of the page together [bytes]
  /// Connections at a time that ask for files. One more takes the place of one that has asked for
  /// nothing since its last answer; if there is none, it is told to try again (503).
  std::size_t connections = 256;
  std::size_t connectionsOfAddress = 128;  ///< the same of one computer
  std::size_t sockets = 256;               ///< WebSockets at a time; one more is told so (503)
  std::size_t socketsOfAddress = 128;      ///< the same of one computer
  double request = 15.0;   ///< time to have an answer read, or to agree on a WebSocket [s]
  double pause = 5.0;      ///< time from an answer to the end of the next request [s]
  double patience = 10.0;  ///< time in which a WebSocket reads nothing of what is sent to it [s]
  double silence = 60.0;   ///< silence of a WebSocket that does not answer a ping either [s]
};

struct WebConfig {
  std::filesystem::path page;        ///< folder of the built page; without it a note stands there
  std::vector<std::string> hosts;    ///< names of this computer, beside localhost and addresses
  std::vector<std::string> origins;  ///< foreign pages that may connect: "https://..."
  std::vector<WebProtocol> protocols = {boardProtocol()};
  WebUploads uploads;  ///< files that the page sends; usually none are taken
  WebLimits limits;
  /// Is called with what goes wrong, one line each, on the door's thread; may be empty.
  std::function<void(const std::string&)> log;
};

/// A connection that speaks HTTP.
struct WebVisitor {
  int socket = -1;   ///< connected and non-blocking
  std::string head;  ///< all that was read of it: a request's head, and whatever came behind it
  std::string peer;  ///< its computer; its connections are counted together
  /// Makes a connection to the board for it, as a client of its own computer. @returns a connected,
  /// non-blocking local socket (AF_UNIX), or -1 if there is none to be had; thread-safe, at any
  /// time
  std::function<int()> join;
};

/// Lets web browsers in that come to the message board's port: gives them the files of a page, and
/// joins each WebSocket to a connection of its own to the board, whose limits, roles and tokens
/// hold for it as for any client of the computer that it comes from.
///
/// A foreign page can't use it: requests must name this computer by an address, as
/// localhost or by a name of WebConfig::hosts (else DNS could be made to lead a strange page here),
/// and the Origin of a WebSocket or of a file that is sent must be the page's own or one of
/// WebConfig::origins.
///
///     WebDoor door(webConfig);
///     boardConfig.http = [&](const HttpVisitor& visitor) {
///       return door.take({visitor.socket, visitor.head, visitor.peer, visitor.join});
///     };
///     MessageBoard board(world, boardConfig);
class ORTUNG_API WebDoor {
 public:
  /// Reads the page's files and starts a thread.
  /// @throws std::runtime_error if the folder is there but can't be read, or is too large
  explicit WebDoor(const WebConfig& config);
  /// Closes all connections.
  ~WebDoor();
  WebDoor(const WebDoor&) = delete;
  WebDoor& operator=(const WebDoor&) = delete;

  /// Whether there is a page.
  bool hasPage() const;
  /// Takes a connection, and closes its socket when that is done. Thread-safe.
  /// @returns false if too many wait to be looked at: then the socket is still the caller's
  bool take(const WebVisitor& visitor);
  /// Connections at present. Thread-safe.
  std::size_t connections() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung

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

namespace ortung {

/// What browsers may take, at most.
struct WebLimits {
  std::size_t head = 16u << 10;      ///< head of a request [bytes]
  std::size_t message = 128u << 10;  ///< a client's message over a WebSocket [bytes]
  std::size_t page = 16u << 20;      ///< all files of the page together [bytes]
  std::size_t connections = 256;     ///< connections at a time
  double request = 15.0;             ///< time to receive a request, or to have its answer read [s]
  double silence = 60.0;  ///< silence of a WebSocket that does not answer a ping either [s]
};

struct WebConfig {
  std::filesystem::path page;        ///< folder of the built page; without it a note stands there
  std::vector<std::string> hosts;    ///< names of this computer, beside localhost and addresses
  std::vector<std::string> origins;  ///< foreign pages that may connect: "https://..."
  std::vector<WebProtocol> protocols = {boardProtocol()};
  WebLimits limits;
  /// Is called with what goes wrong, one line each, on the door's thread; may be empty.
  std::function<void(const std::string&)> log;
};

/// Lets web browsers in that come to the message board's port: gives them the files of a page, and
/// joins each WebSocket to a connection of its own to the board, whose limits, roles and tokens
/// hold for it as for any client.
///
/// A foreign page can't use it: requests must name this computer by an address, as
/// localhost or by a name of WebConfig::hosts (else DNS could be made to lead a strange page here),
/// and a WebSocket's Origin must be the page's own or one of WebConfig::origins.
///
///     WebDoor door(webConfig);
///     boardConfig.http = [&](int socket, const std::string& head) { return door.take(socket,
///     head); };
///     MessageBoard board(world, boardConfig);
///     door.open("127.0.0.1", board.port());
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
  /// Where the board listens; until then WebSockets are refused. Thread-safe.
  void open(const std::string& address, std::uint16_t port);
  /// A connection that speaks HTTP, see HttpTaker. Thread-safe.
  bool take(int socket, const std::string& head);
  /// Connections at present. Thread-safe.
  std::size_t connections() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung

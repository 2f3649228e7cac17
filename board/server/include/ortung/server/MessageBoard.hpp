#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/server/BoardCommand.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {

/// What clients may use at most. A request for more is refused with the limit.
struct BoardLimits {
  std::size_t line = 64u << 10;           ///< length of a client's line [bytes]
  std::size_t configuration = 64u << 10;  ///< length of a robot's configuration [bytes]
  std::size_t robots = 4;                 ///< robots per client
  std::size_t sensors = 16;               ///< sensors per robot
  std::size_t features = 1024;            ///< features per robot
  double rays = 1e6;           ///< rays that a robot's sensors cost [1/s], see Sensor::rays()
  double allRays = 2e7;        ///< rays that all robots' sensors cost together [1/s]
  double allRaysAtOnce = 2e6;  ///< rays for one reading of each sensor of all robots
  /// Clients connected at a time. Connections that have not shown yet what they speak are not
  /// clients: there may be as many of them again, then the oldest goes when another one comes.
  std::size_t sessions = 256;
  std::size_t sessionsOfAddress = 128;  ///< the same of one computer
  std::size_t httpHead = 16u << 10;     ///< head of a web browser's request [bytes]
  std::size_t output = 1u << 20;        ///< unread output of a client [bytes]; more: it is dropped
  std::size_t readings = 16u << 20;     ///< unread readings too large for a line [bytes]
  std::size_t orders = 64;              ///< a client's orders that the world has not executed
  double talkLines = 1000.0;  ///< lines to others caused by a client [1/s], counted per listener
  double talkBytes = 256.0 * 1024.0;  ///< bytes to others caused by a client [bytes/s]
  std::size_t say = 4096;             ///< length of one text to say [bytes]
  std::size_t talk = 64u << 10;       ///< others' words waiting for a client [bytes]; more: lost
  std::size_t queries = 64;           ///< queries in one request for readings
  double slowShare = 0.25;   ///< share of a processor that slow commands have together, in (0, 1]
  double seekShare = 0.25;   ///< share of the world's time that goes into SEEK, in (0, 1]
  std::size_t errors = 100;  ///< a client's errors in a row; more: it is dropped
  double handshake = 5.0;    ///< time from connecting to HELLO [s]
  double head = 3.0;         ///< time from connecting to the end of HTTP's head [s]
  double idle = 30.0;        ///< silence of a client that has not subscribed [s]
  double refusal = 2.0;  ///< delay of the answer to a wrong token, and of greetings from the same
                         ///< computer in the minute after it [s]
  double stall = 10.0;   ///< time during which a client reads none of its output [s]
};

/// How time passes.
enum class Pace {
  kRealTime,  ///< time runs `speed` times as fast as real time
  kFree,      ///< time runs as fast as the computer can
  kLockstep,  ///< a cycle begins when all lockstep clients have asked for it
};

/// A token that lets a client in.
struct BoardToken {
  std::string name;  ///< name of the client; "*": any that has no token of its own
  std::string token;
};

/// A connection to the board's port that speaks HTTP instead of the protocol.
struct HttpVisitor {
  int socket = -1;  ///< connected and non-blocking; nothing is read from it any more
  /// All that was read: the request's head with the empty line that ends it, at most
  /// BoardLimits::httpHead bytes, and whatever has come behind it.
  std::string head;
  std::string peer;  ///< its computer: the address, of IPv6 the network
  /// Makes a connection to the board for it, whose limits hold for it as if it had come from the
  /// visitor's computer by itself. @returns a connected, non-blocking socket that speaks the
  /// protocol, or -1 if there is no board any more, or no socket. Thread-safe, at any time.
  std::function<int()> join;
};

/// Gets connections to the board's port that speak HTTP.
/// @returns whether it has taken the connection: then it closes the socket when it is done;
///   otherwise the board answers that there is no room, and closes it
/// Called on the thread that talks to clients, so it must not wait; it may throw: not taken.
using HttpTaker = std::function<bool(const HttpVisitor& visitor)>;

/// How a board listens, whom it lets in, and how its world's time passes.
struct BoardConfig {
  std::string address = "127.0.0.1";  ///< address to listen on; others than loopback need tokens
  std::uint16_t port = 0;             ///< port to listen on; 0: the system chooses
  std::vector<BoardToken> tokens;     ///< clients' tokens; none: every client may come in
  /// Tokens are for their own names alone: clients of other names come in without. Only where
  /// no computer but this one can connect.
  bool guests = false;
  /// Clients who may control the simulation; "*": all. Where there are tokens, each of these names
  /// needs one of its own.
  std::vector<std::string> control;
  Pace pace = Pace::kRealTime;
  double speed = 1.0;
  BoardLimits limits;
  std::vector<BoardCommand> commands;  ///< beside those of the protocol
  HttpTaker http;                      ///< empty: the board answers that it is no web server
  /// Is called with what happens, one line each, from any thread; may be empty.
  std::function<void(const std::string&)> log;
};

/// What has happened since run() began, and who is there now.
struct BoardStatistics {
  std::uint64_t cycles = 0;
  std::uint64_t missedCycles = 0;  ///< cycles in real time that began after the next one was due
  std::size_t clients = 0;
  std::size_t robots = 0;
};

/// The server of a world: clients connect over TCP and speak the protocol of docs/protocol.md.
///
/// One thread, that of run(), owns the world; one more talks to all clients. They exchange orders
/// and readings, so no client can make the world wait.
/// Not thread-safe, but for what says so.
class ORTUNG_API MessageBoard {
 public:
  /// Listens from now on.
  /// @param world borrowed; a live one is served in real time at its own speed
  /// @throws std::invalid_argument for a configuration that makes no sense
  /// @throws std::runtime_error if it can't listen there
  MessageBoard(ServedWorld& world, const BoardConfig& config);
  ~MessageBoard();
  MessageBoard(const MessageBoard&) = delete;
  MessageBoard& operator=(const MessageBoard&) = delete;

  /// The port that it listens on, also if the system chose it.
  std::uint16_t port() const;

  /// Serves until stop() is called or @p goesOn, asked ten times a second, says no; then all
  /// clients get a BYE. Once only.
  void run(const std::function<bool()>& goesOn = {});
  void stop();  ///< thread-safe

  /// For a world whose cycle does not come back, so that run() never will: refuses new clients
  /// and sends the reason to all others. What remains is to end the program. Thread-safe.
  /// @returns whether that was done within a second
  bool abandon(const std::string& why);

  BoardStatistics statistics() const;  ///< thread-safe

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ortung {

/// A command that the host of a message board adds to the protocol; HELP lists it. The board
/// refuses one without name or handler, or whose name is another's or one of the protocol's.
struct BoardCommand {
  /// What a client may do.
  enum class Role : std::uint8_t { kViewer, kPlayer, kOperator };
  /// What a client said: "NAME word ... key=value ...".
  struct Call {
    std::string client;  ///< its name
    std::vector<std::string> words;
    std::map<std::string, std::string> keys;  ///< a key that is there twice is refused before
    Role role = Role::kViewer;
    /// Whether the client still waits for the answer; thread-safe, never empty.
    std::function<bool()> isAwaited = [] { return true; };
  };
  /// "OK NAME words" or, if there are lines, "OK NAME words lines=N" and the lines behind it, or,
  /// if there are bytes, "OK NAME words bytes=N" and the bytes as they are; not both. What is not
  /// printable ASCII in words and lines becomes '?'.
  struct Reply {
    std::string words;  ///< e.g. "angle_deg=30"; may be empty
    std::vector<std::string> lines = {};
    std::string bytes = {};
  };

  std::string name;            ///< capitals, digits and '_', beginning with a capital, at most 32
  std::string help;            ///< its arguments and what it does, one line; may be empty
  Role least = Role::kViewer;  ///< least role that may use the command
  /// Executes it, on the thread of MessageBoard::run(), between two steps of the world: it may use
  /// the world, and whatever takes long holds it up.
  /// @throws ServeError to refuse it, answered as "ERR code text"; other errors as the board's own
  std::function<Reply(const Call&)> handle;
  /// It takes long: handle() is called on a thread of the board that has nothing else to do, the
  /// lowest priority, and a share of a processor (BoardLimits::slowShare), so it holds up neither
  /// the world nor other clients, but must be thread-safe. The same client's lines behind it wait
  /// for it; they are executed one after the other, clients by turns. One that asks
  /// Call::isAwaited() again and again, without a lock, is held up there when it has to be.
  bool isSlow = false;
  /// It only asks for something, so a client's newer one that comes before this one was begun takes
  /// its place, and it is answered "ERR superseded". For slow ones.
  bool isReplaceable = false;
};

}  // namespace ortung

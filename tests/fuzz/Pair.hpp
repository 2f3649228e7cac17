#pragma once

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>
#include <string_view>

#include "Fuzz.hpp"

namespace ortung::fuzz {

/// Pieces in which an input is said at most: each costs some system calls, and a long input is cut
/// in enough places by so many.
inline constexpr std::size_t kMostPieces = 128;

/// Two connected sockets: one is the target's, the other one the input's. Nothing waits.
class Pair {
 public:
  Pair() {
    require(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, both_.data()) ==
            0);
  }
  ~Pair() {
    for (const int socket : both_)
      if (socket >= 0) ::close(socket);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  /// The target's, which closes it.
  int take() { return std::exchange(both_[0], -1); }
  /// @returns how much there was room for
  std::size_t say(std::string_view bytes) {
    const auto sent = ::send(both_[1], bytes.data(), bytes.size(), MSG_NOSIGNAL);
    return sent < 0 ? 0 : static_cast<std::size_t>(sent);
  }
  /// Says no more.
  void end() { ::shutdown(both_[1], SHUT_WR); }
  /// All that the target has said since.
  std::string heard() {
    std::string all;
    for (ssize_t count = 0; (count = ::recv(both_[1], piece().data(), piece().size(), 0)) > 0;)
      all.append(piece().data(), static_cast<std::size_t>(count));
    return all;
  }

 private:
  /// Not on the stack, where the sanitizer marks all of it at each call.
  static std::array<char, 65536>& piece() {
    static std::array<char, 65536> bytes;
    return bytes;
  }
  std::array<int, 2> both_{-1, -1};
};

}  // namespace ortung::fuzz

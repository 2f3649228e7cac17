#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ortung::test {

/// A referee box as the league's speaks: a TCP server, messages in JSON with a NUL byte behind
/// each. It serves one team, on a port that the system chooses.
class StandInBox {
 public:
  StandInBox() { listen(0); }
  ~StandInBox() {
    hangUp();
    close();
  }
  StandInBox(const StandInBox&) = delete;
  StandInBox& operator=(const StandInBox&) = delete;

  std::uint16_t port() const { return port_; }
  bool hasClient() const { return client_ >= 0; }

  /// Takes what there is: a connection, bytes. @param milliseconds to wait for it
  void look(int milliseconds = 1) {
    pollfd watched{client_ >= 0 ? client_ : listener_, POLLIN, 0};
    if (::poll(&watched, 1, milliseconds) <= 0) return;
    if (client_ < 0) {
      client_ = ::accept(listener_, nullptr, nullptr);
      return;
    }
    std::array<char, 4096> bytes{};
    const ssize_t count = ::recv(client_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (count > 0) {
      received_.append(bytes.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EAGAIN) {
      hangUp();
    }
  }

  /// Whole messages so far.
  std::vector<std::string> messages() const {
    std::vector<std::string> messages;
    std::string_view rest = received_;
    for (auto end = rest.find('\0'); end != rest.npos; end = rest.find('\0')) {
      messages.emplace_back(rest.substr(0, end));
      rest.remove_prefix(end + 1);
    }
    return messages;
  }

  void command(const std::string& command, const std::string& team = "") {
    say("{\"command\": \"" + command + "\", \"targetTeam\": \"" + team + "\"}");
  }
  void say(const std::string& message) { send(message + std::string(1, '\0')); }
  void send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count =
          ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count < 0) throw std::runtime_error(std::string("send: ") + std::strerror(errno));
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  /// The client's connection ends.
  void hangUp() {
    if (client_ >= 0) ::close(client_);
    client_ = -1;
    received_.clear();
  }
  /// The box is switched off, and on again on the same port.
  void close() {
    if (listener_ >= 0) ::close(listener_);
    listener_ = -1;
  }
  void open() { listen(port_); }

 private:
  void listen(std::uint16_t port) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    if (::bind(listener_, generic, size) != 0 || ::listen(listener_, 4) != 0 ||
        ::getsockname(listener_, generic, &size) != 0)
      throw std::runtime_error(std::string("no port: ") + std::strerror(errno));
    port_ = ntohs(address.sin_port);
  }

  int listener_ = -1;
  int client_ = -1;
  std::uint16_t port_ = 0;
  std::string received_;
};

}  // namespace ortung::test

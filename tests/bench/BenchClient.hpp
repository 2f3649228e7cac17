#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace ortung::bench {

inline sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// A client that sends a request and waits for a reply of a known number of lines.
class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address = loopback(port);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("can't connect");
    const int on = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(const std::string& text) {
    if (::send(socket_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
      throw std::runtime_error("can't send");
  }
  std::string lines(std::ptrdiff_t count) {
    std::string text;
    char piece[65536];
    while (std::count(text.begin(), text.end(), '\n') < count) {
      const ssize_t got = ::recv(socket_, piece, sizeof piece, 0);
      if (got <= 0) throw std::runtime_error("the server closed the connection");
      text.append(piece, static_cast<std::size_t>(got));
    }
    return text;
  }
  /// A reply whose first line says how many bytes follow.
  std::string bytes() {
    std::string text = lines(1);
    const std::size_t end = text.find('\n') + 1;
    const std::size_t key = text.find(" bytes=");
    if (key > end) throw std::runtime_error(text);
    const std::size_t all = end + static_cast<std::size_t>(std::atol(text.c_str() + key + 7));
    char piece[65536];
    while (text.size() < all) {
      const ssize_t got = ::recv(socket_, piece, sizeof piece, 0);
      if (got <= 0) throw std::runtime_error("the server closed the connection");
      text.append(piece, static_cast<std::size_t>(got));
    }
    return text;
  }
  /// HELLO, CREATE, and waits until all features have a reading; returns their number.
  std::ptrdiff_t join(const std::string& robot) {
    send("HELLO ortung/1\n");
    lines(1);
    send("CREATE r drive=wander\n" + robot + ".\n");
    const std::string reply = lines(1);
    if (!reply.starts_with("OK CREATE")) throw std::runtime_error(reply);
    const std::string features = reply.substr(reply.find("features=") + 9);
    const std::ptrdiff_t wanted = std::atol(features.c_str());
    while (true) {
      send("READ\n");
      const std::string head = lines(1);
      const std::ptrdiff_t count = std::atol(head.c_str() + head.find("lines=") + 6);
      const std::ptrdiff_t here = std::count(head.begin(), head.end(), '\n') - 1;
      if (here < count) lines(count - here);
      if (count == wanted) return count + 1;
    }
  }

 private:
  int socket_;
};

}  // namespace ortung::bench

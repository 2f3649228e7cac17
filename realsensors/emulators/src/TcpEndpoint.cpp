#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "ortung/emulators/Endpoint.hpp"

namespace ortung {

TcpEndpoint::TcpEndpoint(std::uint16_t port, std::string address)
    : address_(std::move(address)), port_(port) {
  plug();
}

TcpEndpoint::~TcpEndpoint() { unplug(); }

std::string TcpEndpoint::name() const {
  return listener_ < 0 ? "" : "tcp:" + address_ + ":" + std::to_string(port_);
}

void TcpEndpoint::plug() {
  if (listener_ >= 0) return;
  const auto fail = [this] {
    const std::string why = std::generic_category().message(errno);
    unplug();
    throw std::runtime_error(address_ + " port " + std::to_string(port_) + ": " + why);
  };
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port_);
  if (::inet_pton(AF_INET, address_.c_str(), &place.sin_addr) != 1)
    throw std::runtime_error(address_ + ": expected an address such as 127.0.0.1");
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int yes = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  if (::bind(listener_, reinterpret_cast<const sockaddr*>(&place), sizeof(place)) != 0 ||
      ::listen(listener_, 4) != 0)
    fail();
  socklen_t size = sizeof(place);
  if (::getsockname(listener_, reinterpret_cast<sockaddr*>(&place), &size) != 0) fail();
  port_ = ntohs(place.sin_port);
}

void TcpEndpoint::drop() {
  if (client_ >= 0) ::close(client_);
  client_ = -1;
}

void TcpEndpoint::unplug() {
  drop();
  if (listener_ >= 0) ::close(listener_);
  listener_ = -1;
}

void TcpEndpoint::accept() {
  const int client = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (client < 0) return;
  drop();
  client_ = client;
  const int yes = 1;
  ::setsockopt(client_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
}

void TcpEndpoint::read(std::string& bytes) {
  if (listener_ < 0) return;
  accept();
  char block[4096];
  while (client_ >= 0) {
    const ssize_t count = ::recv(client_, block, sizeof(block), 0);
    if (count > 0) {
      bytes.append(block, static_cast<std::size_t>(count));
      continue;
    }
    if (count == 0 || (errno != EAGAIN && errno != EINTR)) drop();
    return;
  }
}

void TcpEndpoint::write(std::string_view bytes) {
  while (client_ >= 0 && !bytes.empty()) {
    const ssize_t count = ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count <= 0) {
      if (errno != EAGAIN && errno != EINTR) drop();
      return;
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace ortung

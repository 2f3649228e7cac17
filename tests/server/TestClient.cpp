#include "TestClient.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <utility>

#include "Await.hpp"

namespace ortung::test {

TestClient::TestClient(std::uint16_t port, const std::string& from)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (::inet_pton(AF_INET, from.c_str(), &address.sin_addr) != 1 ||
      ::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("the test can't connect from " + from);
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("the test can't connect");
  const int on = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

TestClient::TestClient(Connected connected) : socket_(connected.socket) {
  ::fcntl(socket_, F_SETFL, ::fcntl(socket_, F_GETFL) & ~O_NONBLOCK);
}

TestClient::~TestClient() {
  if (socket_ >= 0) ::close(socket_);
}

void TestClient::send(std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent <= 0) return;  // the server has closed; the next line() says so
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
}

bool TestClient::offer(std::string_view text) {
  char piece[65536];
  while (::recv(socket_, piece, sizeof piece, MSG_DONTWAIT) > 0) {
  }
  const timeval soon{0, 100'000};
  ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &soon, sizeof soon);
  return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) > 0;
}

bool TestClient::fill() {
  pollfd wait{socket_, POLLIN, 0};
  if (::poll(&wait, 1, 60'000) <= 0) throw std::runtime_error("the server keeps silent");
  char piece[65536];
  const ssize_t count = ::recv(socket_, piece, sizeof piece, 0);
  if (count > 0) input_.append(piece, static_cast<std::size_t>(count));
  return count > 0;
}

void TestClient::endInput() { ::shutdown(socket_, SHUT_WR); }

std::string TestClient::line() {
  std::size_t end;
  while ((end = input_.find('\n')) == std::string::npos)
    if (!fill()) return "(closed)";
  std::string text = input_.substr(0, end);
  input_.erase(0, end + 1);
  return text;
}

std::string TestClient::bytes(std::size_t count) {
  while (input_.size() < count && fill()) {
  }
  std::string text = input_.substr(0, count);
  input_.erase(0, count);
  return text;
}

std::string TestClient::ask(const std::string& text) {
  send(text + "\n");
  return line();
}

std::string TestClient::rest() {
  while (fill()) {
  }
  return std::exchange(input_, {});
}

std::string TestClient::lineWith(const std::string& text) {
  std::string next;
  EXPECT_TRUE(comesTrue("a line says " + text, [&] {
    next = line();
    return next.find(text) != std::string::npos || next == "(closed)";
  }));
  return next;
}

void TestClient::kill() {
  const linger now{1, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
  ::close(socket_);
  socket_ = -1;
}

void TestClient::shrinkBuffer() {
  const int size = 4096;
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &size, sizeof size);
}

std::string TestClient::join(const std::string& robotFile, const std::string& name,
                             const std::string& place, const std::string& robot) {
  const std::string hello = ask("HELLO ortung/1 name=" + name);
  if (!hello.starts_with("OK HELLO")) throw std::runtime_error("the server said: " + hello);
  send("CREATE " + (robot.empty() ? name : robot) + " " + place + "\n" + robotFile + ".\n");
  return line();
}

std::string valueOf(const std::string& reply, const std::string& key) {
  const std::size_t found = (" " + reply).find(" " + key + "=");
  if (found == std::string::npos) return "";
  const std::size_t begin = found + key.size() + 1;
  return reply.substr(begin, reply.find(' ', begin) - begin);
}

}  // namespace ortung::test

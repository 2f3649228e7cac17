#include "LineSocket.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "ortung/client/RobotSession.hpp"

namespace ortung::client {
namespace {

constexpr std::size_t kLongestLine = 256u << 20;  // an image of 2^24 words fits

/// For poll(), which waits for ever if it is told less than 0.
int milliseconds(double seconds) {
  return static_cast<int>(std::clamp(seconds * 1000.0, 0.0, 2e9));
}

}  // namespace

StopSignal::StopSignal(const std::stop_token& stop) : stop_(stop) {
  if (!stop.stop_possible()) return;
  descriptor_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (descriptor_ < 0) throw ConnectionLost(std::string("no eventfd: ") + std::strerror(errno));
  callback_.emplace(stop, [this] { ::eventfd_write(descriptor_, 1); });
}

StopSignal::~StopSignal() {
  callback_.reset();  // waits for one that is being called
  if (descriptor_ >= 0) ::close(descriptor_);
}

LineSocket::LineSocket(const SessionOptions& options)
    : server_(options.server()),
      timeout_(options.timeout),
      isInterruptible_(options.isInterruptible),
      stop_(options.stop) {
  try {
    connect(options.host, options.port);
  } catch (...) {
    if (socket_ >= 0) ::close(socket_);
    throw;
  }
}

LineSocket::~LineSocket() {
  if (socket_ >= 0) ::close(socket_);
}

void LineSocket::fail(const std::string& what) const {
  throw ConnectionLost(server_ + ": " + what);
}

void LineSocket::connect(const std::string& host, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
  if (error != 0) fail(std::string("there is no such computer: ") + ::gai_strerror(error));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(list, ::freeaddrinfo);
  std::string why = "no address";
  for (const addrinfo* address = list; address != nullptr; address = address->ai_next) {
    socket_ = ::socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket_ < 0) {  // e.g. an address of IPv6 where the system has none
      why = std::strerror(errno);
      continue;
    }
    int result = ::connect(socket_, address->ai_addr, address->ai_addrlen);
    int code = result == 0 ? 0 : errno;
    if (code == EINPROGRESS) {
      wait(POLLOUT, timeout_);
      socklen_t size = sizeof code;
      ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &code, &size);
    }
    if (code == 0) {
      const int on = 1;
      ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      return;
    }
    why = std::strerror(code);
    ::close(socket_);
    socket_ = -1;
  }
  fail("can't connect: " + why);
}

void LineSocket::wait(short events, double timeout) {
  pollfd polled[] = {{socket_, events, 0}, {stop_.descriptor(), POLLIN, 0}};
  while (true) {
    const int ready = ::poll(polled, 2, milliseconds(timeout));
    if (stop_.isRequested()) fail("stopped");
    if (ready > 0) return;
    if (ready == 0) fail("keeps silent for more than " + std::to_string(timeout) + " s");
    if (errno != EINTR) fail(std::strerror(errno));
    if (isInterruptible_) fail("interrupted");
  }
}

void LineSocket::send(std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent >= 0) {
      text.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      wait(POLLOUT, timeout_);
    } else if (errno != EINTR) {
      fail(std::string("the connection broke: ") + std::strerror(errno));
    }
  }
}

/// Waits for some bytes. @returns how many
std::size_t LineSocket::receive(std::span<char> out, double timeout) {
  while (true) {
    if (stop_.isRequested()) fail("stopped");  // who talks without end need not be waited for
    const ssize_t count = ::recv(socket_, out.data(), out.size(), 0);
    if (count > 0) return static_cast<std::size_t>(count);
    if (count == 0) fail("the server closed the connection");
    if (errno == EAGAIN || errno == EWOULDBLOCK)
      wait(POLLIN, timeout);
    else if (errno != EINTR)
      fail(std::string("the connection broke: ") + std::strerror(errno));
  }
}

void LineSocket::fill(double timeout) {
  char piece[65536];
  input_.append(piece, receive(piece, timeout));
}

void LineSocket::read(std::span<char> out, double timeout) {
  forgetTaken();
  const std::size_t have = std::min(out.size(), input_.size());
  std::copy_n(input_.data(), have, out.data());
  taken_ = have;
  for (out = out.subspan(have); !out.empty();) out = out.subspan(receive(out, timeout));
}

void LineSocket::forgetTaken() {
  input_.erase(0, taken_);
  taken_ = 0;
}

std::string_view LineSocket::line(double timeout) {
  forgetTaken();
  std::size_t searched = 0;
  std::size_t end;
  while ((end = input_.find('\n', searched)) == std::string::npos) {
    searched = input_.size();
    if (searched > kLongestLine) fail("sent a line that does not end");
    fill(timeout);
  }
  taken_ = end + 1;
  return std::string_view(input_).substr(0, end);
}

}  // namespace ortung::client

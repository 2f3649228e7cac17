#include "ortung/devices/Port.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "LineSpeed.hpp"

namespace ortung {
namespace {

constexpr int kConnecting = 2000;  // longest wait for a connection [ms]
constexpr int kWriting = 500;      // longest wait for a write [ms]
constexpr int kMostBlocks = 256;   // of 64 KiB that are dropped at once
constexpr std::string_view kTcp = "tcp:";

std::string reason(int error) { return std::generic_category().message(error); }

/// Waits for @p events or an error; false after @p milliseconds.
bool waitFor(int descriptor, short events, int milliseconds) {
  pollfd one{descriptor, events, 0};
  return ::poll(&one, 1, milliseconds) > 0;
}

void setUp(int line, const std::string& name, int baud) {
  termios settings{};
  if (::tcgetattr(line, &settings) != 0)
    throw DeviceAbsent(name + ": is not a serial line: " + reason(errno));
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  ::cfsetspeed(&settings, *codeOf(baud));
  if (::tcsetattr(line, TCSANOW, &settings) != 0)
    throw DeviceAbsent(name + ": can't be set to " + std::to_string(baud) +
                       " baud: " + reason(errno));
  ::tcflush(line, TCIFLUSH);  // what came before is out of date
}

int openLine(const std::string& name) {
  const int line = ::open(name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (line < 0) throw DeviceAbsent(name + ": " + reason(errno));
  return line;
}

/// Connects within kConnecting. @return the socket, or -1 and errno
int connectTo(const addrinfo& address) {
  const int socket = ::socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                              address.ai_protocol);
  if (socket < 0) return -1;
  int error = 0;
  if (::connect(socket, address.ai_addr, address.ai_addrlen) != 0) {
    error = errno;
    if (error == EINPROGRESS) {
      socklen_t size = sizeof(error);
      error = ETIMEDOUT;
      if (waitFor(socket, POLLOUT, kConnecting))
        ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
    }
  }
  if (error == 0) {
    const int yes = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    return socket;
  }
  ::close(socket);
  errno = error;
  return -1;
}

int openServer(const std::string& name) {
  const std::string place = name.substr(kTcp.size());
  const std::size_t colon = place.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == place.size())
    throw std::invalid_argument("port '" + name + "': expected tcp:HOST:PORT");
  std::string host = place.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']')
    host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(host.c_str(), place.c_str() + colon + 1, &hints, &found);
  if (error != 0) throw DeviceAbsent(name + ": " + ::gai_strerror(error));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, ::freeaddrinfo);
  int socket = -1;
  for (const addrinfo* one = found; one != nullptr && socket < 0; one = one->ai_next)
    socket = connectTo(*one);
  if (socket < 0) throw DeviceAbsent(name + ": " + reason(errno));
  return socket;
}

}  // namespace

DeviceAbsent::~DeviceAbsent() = default;

bool isLineSpeed(int baud) { return codeOf(baud).has_value(); }

Port::Port(std::string name, int descriptor) : name_(std::move(name)), descriptor_(descriptor) {}

Port::~Port() { ::close(descriptor_); }

std::unique_ptr<Port> Port::open(const std::string& name, int baud) {
  if (name.starts_with(kTcp)) return std::unique_ptr<Port>(new Port(name, openServer(name)));
  if (name.empty()) throw std::invalid_argument("port '': expected /dev/... or tcp:HOST:PORT");
  if (!isLineSpeed(baud))
    throw std::invalid_argument("port '" + name + "': serial lines have no speed of " +
                                std::to_string(baud) + " baud");
  std::unique_ptr<Port> port(new Port(name, openLine(name)));
  setUp(port->descriptor_, name, baud);
  return port;
}

bool Port::read(std::string& bytes, std::chrono::milliseconds patience, std::size_t most) {
  pollfd one{descriptor_, POLLIN, 0};
  const int ready = ::poll(&one, 1, static_cast<int>(patience.count()));
  if (ready <= 0) return false;  // nothing came, or a signal did
  const std::size_t before = bytes.size();
  bytes.resize(before + most);
  const ssize_t count = ::read(descriptor_, bytes.data() + before, most);
  const int error = errno;
  bytes.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  if (count > 0) return true;
  const bool isNothing = error == EAGAIN || error == EINTR;
  if (count < 0 && isNothing && (one.revents & (POLLHUP | POLLERR)) == 0) return false;
  throw DeviceAbsent(name_ + ": " + (count == 0 || isNothing ? "was closed" : reason(error)));
}

/// What a server still sends while this reads is left: it is bounded, so that a flood is no trap.
void Port::drop() {
  if (::tcflush(descriptor_, TCIFLUSH) == 0) return;
  std::array<char, 1U << 16> block;
  for (int i = 0; i < kMostBlocks; ++i)
    if (::read(descriptor_, block.data(), block.size()) <= 0) return;
}

void Port::write(std::string_view bytes) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(kWriting);
  while (!bytes.empty()) {
    // A connection that was closed must not raise a signal.
    ssize_t count = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == ENOTSOCK) count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
      continue;
    }
    if (errno != EAGAIN && errno != EINTR) throw DeviceAbsent(name_ + ": " + reason(errno));
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0 || !waitFor(descriptor_, POLLOUT, static_cast<int>(left)))
      throw DeviceAbsent(name_ + ": takes no more bytes");
  }
}

}  // namespace ortung

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ortung::client {

/// A TCP connection that carries lines. Not thread-safe.
/// All members throw ConnectionLost saying what happened to which server.
class LineSocket {
 public:
  /// @param isInterruptible whether a signal ends what is under way
  LineSocket(const std::string& host, std::uint16_t port, double timeout, bool isInterruptible);
  ~LineSocket();
  LineSocket(const LineSocket&) = delete;
  LineSocket& operator=(const LineSocket&) = delete;

  void send(std::string_view text);
  /// The next line without its end; valid until the next call.
  /// @param timeout of silence [s]
  std::string_view line(double timeout);
  /// The next bytes, whatever they are; valid as line() is.
  std::string_view bytes(std::size_t count, double timeout);

 private:
  void connect(const std::string& host, std::uint16_t port, double timeout);
  void wait(short events, double timeout);
  void fill(double timeout);
  void forgetTaken();
  [[noreturn]] void fail(const std::string& what) const;

  std::string server_;  ///< "HOST:PORT"
  double timeout_;
  bool isInterruptible_;
  int socket_ = -1;
  std::string input_;
  std::size_t taken_ = 0;
};

}  // namespace ortung::client

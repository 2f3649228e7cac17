#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>

namespace ortung {
struct SessionOptions;
}

namespace ortung::client {

/// A file descriptor that is readable from the moment on when a stop is requested.
class StopSignal {
 public:
  explicit StopSignal(const std::stop_token& stop);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  /// -1, which poll() passes over, if nobody can request it.
  int descriptor() const { return descriptor_; }
  bool isRequested() const { return stop_.stop_requested(); }

 private:
  std::stop_token stop_;
  int descriptor_ = -1;
  std::optional<std::stop_callback<std::function<void()>>> callback_;
};

/// A TCP connection that carries lines. Not thread-safe.
/// All members throw ConnectionLost saying what happened to which server.
class LineSocket {
 public:
  explicit LineSocket(const SessionOptions& options);
  ~LineSocket();
  LineSocket(const LineSocket&) = delete;
  LineSocket& operator=(const LineSocket&) = delete;

  void send(std::string_view text);
  /// The next line without its end; valid until the next call.
  /// @param timeout of silence [s]
  std::string_view line(double timeout);
  /// Fills @p out with the next bytes, whatever they are.
  void read(std::span<char> out, double timeout);

 private:
  void connect(const std::string& host, std::uint16_t port);
  void wait(short events, double timeout);
  void fill(double timeout);
  std::size_t receive(std::span<char> out, double timeout);
  void forgetTaken();
  [[noreturn]] void fail(const std::string& what) const;

  std::string server_;  ///< "HOST:PORT"
  double timeout_;      ///< longest wait while connecting and sending [s]
  bool isInterruptible_;
  StopSignal stop_;
  int socket_ = -1;
  std::string input_;
  std::size_t taken_ = 0;
};

}  // namespace ortung::client

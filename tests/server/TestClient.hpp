#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ortung::test {

/// A client that speaks the bare protocol: a blocking socket. Whatever it waits for, it gives up
/// after a minute, so that a broken server fails a test instead of hanging it.
class TestClient {
 public:
  /// @param from address of the client, in 127.0.0.0/8
  explicit TestClient(std::uint16_t port, const std::string& from = "127.0.0.1");
  /// Of a socket that is connected already; it is closed.
  struct Connected {
    int socket;
  };
  explicit TestClient(Connected connected);
  ~TestClient();
  TestClient(const TestClient&) = delete;
  TestClient& operator=(const TestClient&) = delete;

  void send(std::string_view text);
  /// Sends as much as the server takes within a tenth of a second, and throws away what has come.
  /// @returns whether it took any of it
  bool offer(std::string_view text);
  /// Sends a line and returns the next one.
  std::string ask(const std::string& line);
  /// The next line without its end; "(closed)" at the end of the connection.
  std::string line();
  std::string bytes(std::size_t count);
  /// All lines up to the end of the connection.
  std::string rest();
  /// Reads lines until one contains @p text, and returns it.
  std::string lineWith(const std::string& text);
  std::string lineWith(const std::string& text, std::string_view sent) {
    send(sent);
    return lineWith(text);
  }
  /// Sends no more, but still reads: what netcat does at the end of a script.
  void endInput();
  /// Closes at once, as a process that is killed does: the server sees a reset.
  void kill();
  /// Makes the kernel hold back little, so that a slow reader shows soon.
  void shrinkBuffer();

  /// HELLO and CREATE with @p robotFile; returns the reply of CREATE.
  /// @param robot its name; "": that of the client
  std::string join(const std::string& robotFile, const std::string& name = "anna",
                   const std::string& place = "", const std::string& robot = "");

 private:
  bool fill();
  int socket_ = -1;
  std::string input_;
};

/// What stands behind "key=" in a reply.
std::string valueOf(const std::string& reply, const std::string& key);

}  // namespace ortung::test

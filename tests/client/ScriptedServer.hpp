#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>

namespace ortung::test {

/// A server of the protocol that says what a test wants. It talks to one client after the other.
class ScriptedServer {
 public:
  /// Gets a request without its tag and gives the reply without it, which may have further lines
  /// behind it; "" for what a server says that has no features; nothing: keeps silent for good;
  /// kFlood: talks without end, but does not answer.
  using Script = std::function<std::optional<std::string>(const std::string& request)>;
  static constexpr const char* kFlood = "(flood)";
  explicit ScriptedServer(Script script);
  ~ScriptedServer();
  ScriptedServer(const ScriptedServer&) = delete;
  ScriptedServer& operator=(const ScriptedServer&) = delete;

  std::uint16_t port() const { return port_; }
  /// Whether a request was met with silence or a flood.
  bool isHung() const { return isHung_; }

 private:
  void talk(int client);
  bool send(int client, const std::string& text);
  std::optional<std::string> line(int client);

  Script script_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::string input_;
  std::atomic<bool> isHung_{false};
  std::atomic<bool> isOver_{false};
  std::atomic<int> client_{-1};
  std::thread thread_;
};

}  // namespace ortung::test

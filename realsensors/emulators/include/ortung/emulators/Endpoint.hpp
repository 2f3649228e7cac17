#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// The device's end of a line: what a driver opens is the other one. It never waits; what nobody
/// reads is lost, as on a line. Not thread-safe.
class ORTUNG_API Endpoint {
 public:
  virtual ~Endpoint();
  /// What drivers open: "/dev/pts/7", a link to it, or "tcp:127.0.0.1:10940"; "" while unplugged.
  virtual std::string name() const = 0;
  /// A descriptor to poll() for bytes, or -1 while there is none.
  virtual int descriptor() const = 0;
  /// Appends what has come.
  virtual void read(std::string& bytes) = 0;
  virtual void write(std::string_view bytes) = 0;
  /// The speed that the driver has set its end to [bit/s], or nothing where there is no such thing.
  virtual std::optional<int> baud() const { return std::nullopt; }
  virtual void unplug() = 0;
  virtual void plug() = 0;  ///< @throws std::runtime_error
};

/// A pseudo-terminal, which looks like a serial line to whoever opens its other end.
class ORTUNG_API PseudoTerminal : public Endpoint {
 public:
  /// @param link a symbolic link to make to it, replaced if it is one; "" for none
  /// @throws std::runtime_error
  explicit PseudoTerminal(std::filesystem::path link = {});
  ~PseudoTerminal() override;
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  std::string name() const override;
  int descriptor() const override { return master_; }
  void read(std::string& bytes) override;
  void write(std::string_view bytes) override;
  std::optional<int> baud() const override;
  void unplug() override;
  void plug() override;

 private:
  void makeLink();
  std::filesystem::path link_;
  std::string path_;
  int master_ = -1;
  int slave_ = -1;  ///< kept open, so that the line is there while nobody listens
};

/// A server on loopback for one client at a time; the next one takes the place of the last one.
class ORTUNG_API TcpEndpoint : public Endpoint {
 public:
  /// @param port 0: the system chooses. @throws std::runtime_error
  explicit TcpEndpoint(std::uint16_t port, std::string address = "127.0.0.1");
  ~TcpEndpoint() override;
  TcpEndpoint(const TcpEndpoint&) = delete;
  TcpEndpoint& operator=(const TcpEndpoint&) = delete;

  std::string name() const override;
  std::uint16_t port() const { return port_; }
  int descriptor() const override { return client_ >= 0 ? client_ : listener_; }
  void read(std::string& bytes) override;
  void write(std::string_view bytes) override;
  void unplug() override;
  void plug() override;

 private:
  void drop();
  void accept();
  std::string address_;
  std::uint16_t port_;
  int listener_ = -1;
  int client_ = -1;
};

}  // namespace ortung

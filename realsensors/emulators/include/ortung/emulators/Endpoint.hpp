#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// The device's end of a line, whose other end a driver opens. It never waits; bytes that are not
/// read are lost, as on a real line. Not thread-safe.
class ORTUNG_API Endpoint {
 public:
  virtual ~Endpoint();
  /// The port that drivers open: "/dev/pts/7", a link to it, or "tcp:127.0.0.1:10940"; "" while
  /// it is unplugged.
  virtual std::string name() const = 0;
  /// A descriptor to poll() for bytes, or -1 while there is none.
  virtual int descriptor() const = 0;
  /// Appends the bytes that have come.
  virtual void read(std::string& bytes) = 0;
  /// Sends bytes, as many as the driver's end can take.
  virtual void write(std::string_view bytes) = 0;
  /// The speed to which the driver has set its end [bit/s]; nothing for lines without a speed.
  virtual std::optional<int> baud() const { return std::nullopt; }
  virtual void unplug() = 0;  ///< closes the line
  virtual void plug() = 0;    ///< opens the line @throws std::runtime_error
};

/// A pseudo-terminal, whose other end looks like a serial line.
class ORTUNG_API PseudoTerminal : public Endpoint {
 public:
  /// @param link symbolic link that is made to it, or replaced; "": none
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
  int slave_ = -1;  ///< the driver's end, kept open so that the line exists without a driver
};

/// A server on loopback for one client at a time; a new client replaces the last one.
class ORTUNG_API TcpEndpoint : public Endpoint {
 public:
  /// @param port port of the server; 0: the system chooses
  /// @param address IPv4 address of the server
  /// @throws std::runtime_error
  explicit TcpEndpoint(std::uint16_t port, std::string address = "127.0.0.1");
  ~TcpEndpoint() override;
  TcpEndpoint(const TcpEndpoint&) = delete;
  TcpEndpoint& operator=(const TcpEndpoint&) = delete;

  std::string name() const override;
  /// The server's port.
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

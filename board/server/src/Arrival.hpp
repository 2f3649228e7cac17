#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <string>

#include "Session.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace ortung::server {

/// Who lets connections in.
class Porter {
 public:
  virtual ~Porter();
  /// It speaks the protocol. @param bytes what it has said
  virtual void enter(Newcomer newcomer, std::string_view bytes) = 0;
  /// It kept silent for as long as it may.
  virtual void dismiss(Newcomer newcomer) = 0;
  /// Makes a connection to the board for somebody of that computer, see HttpVisitor::join.
  virtual std::function<int()> joinFor(const std::string& peer) = 0;
  /// It is gone; the arrival is not needed any more.
  virtual void leave(ClientId id) = 0;
};

/// A connection that was accepted and has not shown yet what it speaks. What speaks the protocol
/// becomes a session; what speaks HTTP goes to whoever takes that, or is answered and closed.
/// Never waits. All calls come from the thread of the io_context.
class Arrival : public std::enable_shared_from_this<Arrival> {
 public:
  /// @param porter, config borrowed
  Arrival(boost::asio::ip::tcp::socket socket, Porter& porter, const BoardConfig& config,
          ClientId id);

  void start() { read(); }
  /// Ends the wait if it takes too long. @param now on the computer's clock
  void look(Timestamp now);
  void close();
  const std::string& peer() const { return peer_; }

 private:
  void read();
  void receive(const boost::system::error_code& error, std::size_t count);
  void receiveHead();
  bool isTaken();
  Newcomer newcomer();
  void answer(std::string_view status, std::string_view text);

  boost::asio::ip::tcp::socket socket_;
  const std::string peer_;
  Porter& porter_;
  const BoardConfig& config_;
  const ClientId id_;
  const Timestamp started_;
  std::array<char, 4096> buffer_;
  std::string bytes_;   ///< bytes received so far
  std::string answer_;  ///< response to a request of HTTP; empty: none yet
  Timestamp answered_ = 0;
  bool isHttp_ = false;
  bool isLate_ = false;  ///< it has kept silent for too long
  bool isGone_ = false;
};

}  // namespace ortung::server

#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <memory>
#include <string>
#include <vector>

#include "Conversation.hpp"

namespace ortung::server {

/// A connection that is to be a client's.
struct Newcomer {
  /// Of TCP, or a local one that was made for a visitor of another kind.
  boost::asio::generic::stream_protocol::socket socket;
  std::string peer;  ///< its computer, see addressKey()
  ClientId id = 0;
  Timestamp since = 0;  ///< when it came, on the computer's clock
};

/// What somebody is told who has not said HELLO in time.
std::string lateHello(const BoardLimits& limits);

/// One client's connection: carries the bytes of a conversation. Never waits.
/// All calls come from the thread of the io_context.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(Newcomer newcomer, Host& host);

  /// @param bytes what the client has said already
  void start(std::string_view bytes);
  /// Ends it if the client keeps still for too long. @param now on the computer's clock
  void look(Timestamp now);
  /// Says a last word and closes as soon as it is read.
  void dismiss(const std::string& text);
  void close();

  Conversation& conversation() { return *conversation_; }
  const std::string& peer() const { return peer_; }
  bool hasJoined() const { return conversation_->hasJoined(); }

 private:
  class SocketOutlet;
  void read();
  void write();
  void send(std::string_view text);
  void flush();
  std::size_t writeNow(std::string_view text);
  void writeNow();
  std::vector<boost::asio::const_buffer> nextBuffers();
  void finish();
  void listenToTheEnd();

  boost::asio::generic::stream_protocol::socket socket_;
  const std::string peer_;
  Host& host_;
  const BoardLimits limits_;
  std::shared_ptr<Conversation> conversation_;
  std::array<char, 16384> buffer_;
  Output output_;  ///< bytes to be written to the socket
  std::vector<std::string_view> pieces_;
  Timestamp started_;
  Timestamp heard_;
  Timestamp finished_ = 0;
  Timestamp progressed_;  ///< time when the client last read output [us]
  bool isReading_ = false;
  bool isWriting_ = false;
  bool isFinishing_ = false;
  bool hasEnded_ = false;  ///< the client sends no more
  bool isClosed_ = false;
};

}  // namespace ortung::server

#pragma once

#include <array>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <functional>
#include <memory>
#include <string>

#include "Answers.hpp"
#include "ortung/web/WebSpeech.hpp"

namespace ortung::web {

/// A WebSocket and its connection to the board. A side is listened to only while the other has
/// taken all that was said to it, and the client only while it has read all that was said to
/// itself, so at most what one message causes waits on either side; and a client that reads
/// nothing of that for too long is gone. All calls come from the thread of the io_context.
class Bridge : public std::enable_shared_from_this<Bridge> {
 public:
  struct Way {
    std::string name;  ///< name of the subprotocol that was agreed upon
    std::string peer;  ///< the client's computer
  };
  /// @param board socket of the connection to the board, see WebVisitor::join; it is closed
  /// @param onEnd called once, when both connections are closed
  Bridge(boost::beast::tcp_stream stream, int board, std::unique_ptr<WebSpeech> speech, Way way,
         const WebLimits& limits, std::function<void()> onEnd);
  ~Bridge();

  /// Agrees to @p request.
  void start(const Request& request);
  void close();
  const std::string& peer() const { return way_.peer; }

 private:
  void listenToClient();
  void listenToBoard();
  void say();
  void sayToBoard();
  void sayToClient();
  void sayPiece();
  void end();

  boost::beast::websocket::stream<boost::beast::tcp_stream> client_;
  boost::asio::local::stream_protocol::socket board_;
  boost::asio::steady_timer patience_;
  const double patienceTime_;  ///< [s]
  std::unique_ptr<WebSpeech> speech_;
  const Way way_;
  std::function<void()> onEnd_;
  Request request_;
  boost::beast::flat_buffer message_;
  std::array<char, 64u << 10> bytes_;
  std::string saying_;        ///< bytes that are being sent to the board
  WebSpeech::Frame showing_;  ///< frame that is being sent to the client
  std::size_t said_ = 0;      ///< bytes of it that were sent
  std::size_t shown_ = 0;     ///< frames that were taken from the speech
  bool isReadingClient_ = false;
  bool isReadingBoard_ = false;
  bool isWritingClient_ = false;
  bool isWritingBoard_ = false;
  bool isBoardGone_ = false;
  bool isClosing_ = false;
  bool isOver_ = false;
};

}  // namespace ortung::web

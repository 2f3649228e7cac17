#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <functional>
#include <memory>
#include <string>

#include "Answers.hpp"
#include "ortung/web/WebSpeech.hpp"

namespace ortung::web {

/// A WebSocket and its connection to the board. Each side is listened to only while the other has
/// taken all that was said to it, so at most one message waits on either side. All calls come from
/// the thread of the io_context.
class Bridge : public std::enable_shared_from_this<Bridge> {
 public:
  /// @param name of the subprotocol that was agreed upon
  /// @param onEnd called once, when both connections are closed
  Bridge(boost::beast::tcp_stream stream, std::unique_ptr<WebSpeech> speech, std::string name,
         const WebLimits& limits, std::function<void()> onEnd);
  ~Bridge();

  /// Connects to the board and then agrees to @p request.
  void start(const Request& request, const boost::asio::ip::tcp::endpoint& board);
  void close();

 private:
  void accept();
  void listenToClient();
  void listenToBoard();
  void say();
  void sayToBoard();
  void sayToClient();
  void end();

  boost::beast::websocket::stream<boost::beast::tcp_stream> client_;
  boost::asio::ip::tcp::socket board_;
  std::unique_ptr<WebSpeech> speech_;
  std::string name_;
  std::function<void()> onEnd_;
  Request request_;
  boost::beast::flat_buffer message_;
  std::array<char, 64u << 10> bytes_;
  std::string saying_;        ///< bytes that are being sent to the board
  WebSpeech::Frame showing_;  ///< frame that is being sent to the client
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

#pragma once

#include <array>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "Answers.hpp"
#include "Later.hpp"

namespace ortung::web {

/// A connection of a browser, as long as it asks for files. The first request that is not
/// understood is its last, since where the next one would begin is not known then. All calls come
/// from the thread of the io_context.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  /// Who is told what becomes of it.
  struct Host {
    const Page& page;
    const WebConfig& config;
    /// Takes the connection, on which @p request asks for a WebSocket. @returns whether there was
    /// room for it; otherwise @p stream was not touched
    std::function<bool(boost::beast::tcp_stream& stream, const WebVisitor& visitor,
                       const Request& request, const Speaking& speaking)>
        speak;
    /// The door's thread; null where no files are taken.
    std::shared_ptr<Later> later = {};
  };

  /// @param onEnd called once
  Visit(boost::asio::ip::tcp::socket socket, const WebVisitor& visitor, const Host& host,
        std::function<void()> onEnd);

  void start() { read(); }
  /// Says that there is no room, and ends.
  void refuse();
  void close();

  const std::string& peer() const { return visitor_.peer; }
  /// It takes a place: it has not got its last answer yet.
  bool isServed() const { return stage_ == Stage::kIdle || stage_ == Stage::kServed; }
  /// It has got all that it has asked for, and may ask for more.
  bool isIdle() const { return stage_ == Stage::kIdle; }
  /// Its last answer was sent.
  bool isLeaving() const { return stage_ == Stage::kLeaving; }
  /// Since when it is in this state.
  std::chrono::steady_clock::time_point since() const { return since_; }

 private:
  enum class Stage { kServed, kIdle, kLeaving, kOver };
  void read();
  void receive();
  void receiveHead();
  void beginUpload();
  void readPiece();
  void takePiece(const boost::beast::error_code& error);
  void finishUpload();
  void answerUpload(const WebReply& reply);
  std::string tooLarge() const;
  void write(Response response);
  void leave();
  void drop();
  void enter(Stage stage, double seconds);

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  const WebVisitor visitor_;
  const Host& host_;
  std::function<void()> onEnd_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
  using Piece = boost::beast::http::buffer_body;
  std::optional<boost::beast::http::request_parser<Piece>> sending_;  ///< of a file
  std::unique_ptr<WebUpload> upload_;
  std::optional<WebReply> refused_;  ///< what is said at its end
  std::unique_ptr<std::array<char, 64u << 10>> piece_;
  Response response_;
  std::size_t requests_ = 0;
  Stage stage_ = Stage::kServed;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

}  // namespace ortung::web

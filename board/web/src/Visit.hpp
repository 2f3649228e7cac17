#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "Answers.hpp"

namespace ortung::web {

/// A connection of a browser, as long as it asks for files. All calls come from the thread of the
/// io_context.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  /// Who is told what becomes of it.
  struct Host {
    const Page& page;
    const WebConfig& config;
    /// Takes the connection, on which @p request asks for a WebSocket.
    std::function<void(boost::beast::tcp_stream stream, const Request& request,
                       const Speaking& speaking)>
        speak;
  };

  /// @param head what has been read already @param onEnd called once
  Visit(boost::asio::ip::tcp::socket socket, const std::string& head, const Host& host,
        std::function<void()> onEnd);

  void start() { read(); }
  void close();

 private:
  void read();
  void receive();
  void write(Response response);

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  const Host& host_;
  std::function<void()> onEnd_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
  Response response_;
  bool isOver_ = false;
};

}  // namespace ortung::web

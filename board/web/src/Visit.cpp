#include "Visit.hpp"

#include <algorithm>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <utility>

namespace ortung::web {
namespace {

namespace http = boost::beast::http;
using Error = boost::beast::error_code;

}  // namespace

Visit::Visit(boost::asio::ip::tcp::socket socket, const std::string& head, const Host& host,
             std::function<void()> onEnd)
    : stream_(std::move(socket)), host_(host), onEnd_(std::move(onEnd)) {
  const auto room = buffer_.prepare(head.size());
  std::copy(head.begin(), head.end(), static_cast<char*>(room.data()));
  buffer_.commit(head.size());
}

void Visit::read() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(host_.config.limits.head));
  parser_->body_limit(std::uint64_t{0});  // nothing is taken here
  stream_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(host_.config.limits.request)));
  http::async_read(
      stream_, buffer_, *parser_, [self = shared_from_this()](const Error& error, std::size_t) {
        if (self->isOver_) return;
        if (!error)
          self->receive();
        else if (error == http::error::end_of_stream || error == boost::beast::error::timeout)
          self->close();
        else
          self->write(refusal(Request(), http::status::bad_request,
                              "This is no request that is understood here."));
      });
}

void Visit::receive() {
  const Request request = parser_->release();
  if (!boost::beast::websocket::is_upgrade(request)) {
    write(answer(request, host_.page, host_.config));
    return;
  }
  const Speaking speaking = speakingOf(request, host_.config);
  if (speaking.protocol == nullptr) {
    write(refusal(request, speaking.status, speaking.why));
    return;
  }
  host_.speak(std::move(stream_), request, speaking);
  isOver_ = true;
  onEnd_();
}

void Visit::write(Response response) {
  response_ = std::move(response);
  http::async_write(stream_, response_,
                    [self = shared_from_this()](const Error& error, std::size_t) {
                      if (self->isOver_) return;
                      if (error || self->response_.need_eof() || !self->response_.keep_alive())
                        self->close();
                      else
                        self->read();
                    });
}

void Visit::close() {
  if (std::exchange(isOver_, true)) return;
  Error ignored;
  stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  stream_.close();
  onEnd_();
}

}  // namespace ortung::web

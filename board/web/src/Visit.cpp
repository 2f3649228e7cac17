#include "Visit.hpp"

#include <algorithm>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <utility>

namespace ortung::web {
namespace {

namespace http = boost::beast::http;
using Error = boost::beast::error_code;

constexpr double kFarewell = 2.0;            // time for a browser to close after our answer [s]
constexpr std::size_t kMostRequests = 100;   // of one connection
constexpr std::size_t kDropped = 16u << 10;  // read and forgotten at a time [bytes]

Response notUnderstood() {
  return farewell(http::status::bad_request, "This is no request that is understood here.");
}

}  // namespace

Visit::Visit(boost::asio::ip::tcp::socket socket, const WebVisitor& visitor, const Host& host,
             std::function<void()> onEnd)
    : stream_(std::move(socket)), visitor_(visitor), host_(host), onEnd_(std::move(onEnd)) {
  const std::string& head = visitor_.head;
  const auto room = buffer_.prepare(head.size());
  std::copy(head.begin(), head.end(), static_cast<char*>(room.data()));
  buffer_.commit(head.size());
}

/// All that happens in this stage has so much time together.
void Visit::enter(Stage stage, double seconds) {
  stage_ = stage;
  since_ = std::chrono::steady_clock::now();
  stream_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(seconds)));
}

void Visit::read() {
  const bool takesFiles = static_cast<bool>(host_.config.uploads.begin);
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(host_.config.limits.head));
  parser_->body_limit(takesFiles ? host_.config.uploads.most : std::uint64_t{0});
  enter(requests_ == 0 ? Stage::kServed : Stage::kIdle, host_.config.limits.pause);
  const auto receive = [self = shared_from_this(), takesFiles](const Error& error, std::size_t) {
    if (self->stage_ == Stage::kOver) return;
    if (!error)
      takesFiles ? self->receiveHead() : self->receive();
    else if (error == http::error::end_of_stream || error == boost::beast::error::timeout)
      self->close();
    else if (takesFiles && error == http::error::body_limit)
      self->write(farewell(http::status::payload_too_large, self->tooLarge()));
    else
      self->write(notUnderstood());
  };
  // Where files are taken, what a request has behind its head is read when that is known.
  if (takesFiles)
    http::async_read_header(stream_, buffer_, *parser_, receive);
  else
    http::async_read(stream_, buffer_, *parser_, receive);
}

void Visit::receive() {
  const Request request = parser_->release();
  if (!boost::beast::websocket::is_upgrade(request)) {
    const bool isLast = ++requests_ == kMostRequests;
    Response response = answer(request, host_.page, host_.config);
    if (isLast) response.keep_alive(false);
    write(std::move(response));
    return;
  }
  const Speaking speaking = speakingOf(request, host_.config);
  if (speaking.protocol == nullptr) {
    write(said(request, speaking.status, speaking.why));
  } else if (host_.speak(stream_, visitor_, request, speaking)) {
    stage_ = Stage::kOver;
    onEnd_();
  } else {
    refuse();
  }
}

std::string Visit::tooLarge() const {
  return "A file has at most " + std::to_string(host_.config.uploads.most) + " bytes here.";
}

void Visit::receiveHead() {
  if (wantsUpload(parser_->get(), host_.config))
    beginUpload();
  else if (parser_->is_done())
    receive();
  else
    write(notUnderstood());
}

void Visit::beginUpload() {
  const Request& request = parser_->get();
  if (const auto refused = uploadRefusal(request, host_.config)) {
    answerUpload(*refused);
    return;
  }
  WebReply refused{503, "No file can be taken now."};
  upload_ = host_.config.uploads.begin({request.target().data(), request.target().size()}, refused);
  if (!upload_) {
    answerUpload(refused);
    return;
  }
  sending_.emplace(std::move(*parser_));
  sending_->body_limit(host_.config.uploads.most);
  piece_ = std::make_unique<std::array<char, 64u << 10>>();
  sending_->is_done() ? finishUpload() : readPiece();
}

void Visit::readPiece() {
  sending_->get().body().data = piece_->data();
  sending_->get().body().size = piece_->size();
  enter(Stage::kServed, host_.config.uploads.patience);
  http::async_read(stream_, buffer_, *sending_,
                   [self = shared_from_this()](const Error& error, std::size_t) {
                     if (self->stage_ != Stage::kOver) self->takePiece(error);
                   });
}

void Visit::takePiece(const Error& error) {
  if (error == http::error::body_limit) {
    answerUpload({413, tooLarge()});
    return;
  }
  if (error && error != http::error::need_buffer) {  // it was cut
    close();
    return;
  }
  const std::size_t count = piece_->size() - sending_->get().body().size;
  // Of what is refused the rest is read, too: browsers hear an answer when they have sent all.
  if (!refused_) refused_ = upload_->take({piece_->data(), count});
  if (sending_->is_done())
    finishUpload();
  else
    readPiece();
}

void Visit::finishUpload() {
  if (refused_) {
    answerUpload(*refused_);
    return;
  }
  stream_.expires_never();
  stage_ = Stage::kServed;
  upload_->finish([self = weak_from_this(), later = host_.later](const WebReply& reply) {
    if (!later) return;
    later->run([self, reply] {
      const auto visit = self.lock();
      if (visit && visit->stage_ != Stage::kOver) visit->answerUpload(reply);
    });
  });
}

/// The connection ends with it: of a file that is refused more may still come.
void Visit::answerUpload(const WebReply& reply) {
  upload_.reset();
  Response response = uploadAnswer(Request(), reply);
  response.keep_alive(false);
  write(std::move(response));
}

void Visit::refuse() {
  write(farewell(http::status::service_unavailable,
                 "There are too many visitors from your address, or altogether: try again."));
}

void Visit::write(Response response) {
  response_ = std::move(response);
  enter(Stage::kServed, host_.config.limits.request);
  http::async_write(stream_, response_,
                    [self = shared_from_this()](const Error& error, std::size_t) {
                      if (self->stage_ == Stage::kOver) return;
                      if (error)
                        self->close();
                      else if (self->response_.need_eof() || !self->response_.keep_alive())
                        self->leave();
                      else
                        self->read();
                    });
}

/// Reads and drops what still comes until the browser closes, too: closing earlier would make the
/// kernel discard our answer.
void Visit::leave() {
  Error ignored;
  stream_.socket().shutdown(boost::asio::socket_base::shutdown_send, ignored);
  enter(Stage::kLeaving, kFarewell);
  drop();
}

void Visit::drop() {
  buffer_.clear();
  stream_.async_read_some(buffer_.prepare(kDropped),
                          [self = shared_from_this()](const Error& error, std::size_t) {
                            if (self->stage_ == Stage::kOver) return;
                            if (error)
                              self->close();
                            else
                              self->drop();
                          });
}

void Visit::close() {
  if (std::exchange(stage_, Stage::kOver) == Stage::kOver) return;
  stream_.close();
  upload_.reset();
  onEnd_();
}

}  // namespace ortung::web

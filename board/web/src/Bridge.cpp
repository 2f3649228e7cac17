#include "Bridge.hpp"

#include <boost/asio/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <utility>

namespace ortung::web {
namespace {

namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using Error = boost::beast::error_code;

// Frames are sent in fragments of this size, so that progress is noticed [bytes]
constexpr std::size_t kPiece = 64u << 10;

}  // namespace

Bridge::Bridge(boost::beast::tcp_stream stream, int board, std::unique_ptr<WebSpeech> speech,
               Way way, const WebLimits& limits, std::function<void()> onEnd)
    : client_(std::move(stream)),
      board_(client_.get_executor(), asio::local::stream_protocol(), board),
      patience_(client_.get_executor()),
      patienceTime_(limits.patience),
      speech_(std::move(speech)),
      way_(std::move(way)),
      onEnd_(std::move(onEnd)) {
  using std::chrono::duration;
  using std::chrono::duration_cast;
  using Duration = websocket::stream_base::duration;
  client_.read_message_max(limits.message);
  client_.auto_fragment(false);
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = duration_cast<Duration>(duration<double>(limits.request));
  timeout.idle_timeout = duration_cast<Duration>(duration<double>(limits.silence));
  timeout.keep_alive_pings = true;
  client_.set_option(timeout);
  client_.set_option(websocket::stream_base::decorator([this](websocket::response_type& response) {
    response.set(boost::beast::http::field::sec_websocket_protocol, way_.name);
  }));
}

Bridge::~Bridge() = default;

void Bridge::start(const Request& request) {
  request_ = request;
  // The deadline that the request had; from now on the WebSocket has its own.
  boost::beast::get_lowest_layer(client_).expires_never();
  client_.async_accept(request_, [self = shared_from_this()](const Error& error) {
    if (error || self->isOver_) {
      self->end();
      return;
    }
    self->say();
  });
}

/// Sends what the speech has left, and listens to the side whose opposite has taken everything.
void Bridge::say() {
  if (isOver_) return;
  sayToBoard();
  sayToClient();
  const bool isClientServed = !isWritingClient_ && speech_->toClient.empty();
  if (isClientServed && !isWritingBoard_ && speech_->toBoard.empty()) listenToClient();
  if (isClientServed && !isBoardGone_ && !speech_->isOver) listenToBoard();
  if (!isClientServed || !(isBoardGone_ || speech_->isOver) || isClosing_) return;
  isClosing_ = true;
  client_.async_close(websocket::close_code::normal,
                      [self = shared_from_this()](const Error&) { self->end(); });
}

void Bridge::listenToClient() {
  if (isReadingClient_) return;
  isReadingClient_ = true;
  client_.async_read(message_, [self = shared_from_this()](const Error& error, std::size_t) {
    self->isReadingClient_ = false;
    if (error || self->isOver_) {
      self->end();
      return;
    }
    const auto data = self->message_.cdata();
    self->speech_->fromClient({static_cast<const char*>(data.data()), data.size()},
                              self->client_.got_binary());
    self->message_.consume(self->message_.size());
    self->say();
  });
}

void Bridge::listenToBoard() {
  if (isReadingBoard_) return;
  isReadingBoard_ = true;
  board_.async_read_some(asio::buffer(bytes_),
                         [self = shared_from_this()](const Error& error, std::size_t count) {
                           self->isReadingBoard_ = false;
                           if (self->isOver_) return;
                           if (error)
                             self->isBoardGone_ = true;
                           else
                             self->speech_->fromBoard({self->bytes_.data(), count});
                           self->say();
                         });
}

void Bridge::sayToBoard() {
  if (isWritingBoard_ || speech_->toBoard.empty()) return;
  isWritingBoard_ = true;
  saying_ = std::exchange(speech_->toBoard, {});
  asio::async_write(board_, asio::buffer(saying_),
                    [self = shared_from_this()](const Error& error, std::size_t) {
                      self->isWritingBoard_ = false;
                      if (error) self->isBoardGone_ = true;  // what it said last is still read
                      self->say();
                    });
}

void Bridge::sayToClient() {
  auto& frames = speech_->toClient;
  if (isWritingClient_ || frames.empty() || isClosing_) return;
  isWritingClient_ = true;
  showing_ = std::move(frames[shown_]);
  if (++shown_ == frames.size()) {
    frames.clear();
    shown_ = 0;
  }
  client_.binary(showing_.isBinary);
  said_ = 0;
  sayPiece();
}

void Bridge::sayPiece() {
  const std::string_view piece = std::string_view(showing_.bytes).substr(said_, kPiece);
  said_ += piece.size();
  const bool isLast = said_ == showing_.bytes.size();
  patience_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(patienceTime_)));
  patience_.async_wait([weak = weak_from_this()](const Error& cancelled) {
    const auto self = weak.lock();
    if (cancelled || !self || !self->isWritingClient_) return;
    // It may have expired in the moment in which the next piece began.
    if (self->patience_.expiry() <= std::chrono::steady_clock::now()) self->end();
  });
  client_.async_write_some(isLast, asio::buffer(piece.data(), piece.size()),
                           [self = shared_from_this(), isLast](const Error& error, std::size_t) {
                             self->patience_.cancel();
                             if (error || self->isOver_) {
                               self->isWritingClient_ = false;
                               self->end();
                             } else if (isLast) {
                               self->isWritingClient_ = false;
                               self->say();
                             } else {
                               self->sayPiece();
                             }
                           });
}

void Bridge::close() { end(); }

void Bridge::end() {
  if (std::exchange(isOver_, true)) return;
  Error ignored;
  board_.close(ignored);
  boost::beast::get_lowest_layer(client_).close();
  if (onEnd_) onEnd_();
}

}  // namespace ortung::web

#include "Session.hpp"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>

namespace ortung::server {
namespace {

// Size of one write, so that progress is noticed [bytes]
constexpr std::size_t kPiece = 256u << 10;

constexpr double kFarewell = 2.0;          // time for a client to close after our last reply [s]
constexpr double kLongestFarewell = 60.0;  // time for it to read earlier replies [s]

bool hasPassed(Timestamp since, Timestamp now, double seconds) {
  return toSeconds(now - since) > seconds;
}

}  // namespace

std::string lateHello(const BoardLimits& limits) {
  return "ERR hello it did not come within " + std::to_string(static_cast<int>(limits.handshake)) +
         " s";
}

class Session::SocketOutlet final : public Outlet {
 public:
  explicit SocketOutlet(Session& session) : session_(session) {}
  ~SocketOutlet() override = default;
  void send(std::string_view text) override { session_.send(text); }
  void append(std::string_view text) override {
    if (!session_.isClosed_) session_.output_.add(text);
  }
  void add(Output&& output) override {
    if (!session_.isClosed_) session_.output_.add(std::move(output));
  }
  void flush() override { session_.flush(); }
  std::size_t outstanding() const override { return session_.output_.size(); }
  std::size_t outstandingReadings() const override { return session_.output_.readingBytes(); }
  void finish() override { session_.finish(); }
  void resume() override { session_.read(); }
  const std::string& peer() const override { return session_.peer_; }

 private:
  Session& session_;
};

Session::Session(Newcomer newcomer, Host& host)
    : socket_(std::move(newcomer.socket)),
      peer_(std::move(newcomer.peer)),
      host_(host),
      limits_(host.config.limits),
      conversation_(
          std::make_shared<Conversation>(host, newcomer.id, std::make_unique<SocketOutlet>(*this))),
      started_(newcomer.since),
      heard_(wallTime()),
      progressed_(heard_) {}

void Session::start(std::string_view bytes) {
  boost::system::error_code ignored;
  socket_.non_blocking(true, ignored);
  socket_.set_option(boost::asio::ip::tcp::no_delay(true), ignored);  // not of local ones
  socket_.set_option(boost::asio::socket_base::keep_alive(true), ignored);
  conversation_->receive(bytes);
  read();
}

void Session::read() {
  if (hasEnded_ && !isFinishing_) {
    if (!conversation_->hasOpenRequests()) finish();
    return;
  }
  if (isReading_ || isClosed_ || !(isFinishing_ || conversation_->wantsInput())) return;
  isReading_ = true;
  socket_.async_read_some(
      boost::asio::buffer(buffer_),
      [self = shared_from_this()](const boost::system::error_code& error, std::size_t count) {
        self->isReading_ = false;
        if (error == boost::asio::error::eof && !self->isFinishing_ && !self->isClosed_ &&
            self->conversation_->hasOpenRequests()) {
          // No more requests will come, but the client may wait for replies: a script piped into
          // netcat does.
          self->hasEnded_ = true;
          self->heard_ = wallTime();
          return;
        }
        if (error || self->isClosed_) {
          self->close();
          return;
        }
        self->heard_ = wallTime();
        if (!self->isFinishing_) self->conversation_->receive({self->buffer_.data(), count});
        self->read();
      });
}

void Session::send(std::string_view text) {
  if (isClosed_) return;
  if (isWriting_ || !output_.isEmpty()) {
    output_.add(text);
    flush();
    return;
  }
  text.remove_prefix(writeNow(text));
  if (text.empty()) return;
  output_.add(text);
  write();
}

void Session::flush() {
  if (isClosed_ || isWriting_ || output_.isEmpty()) return;
  writeNow();
  if (output_.isEmpty())
    host_.listen(*conversation_);
  else
    write();
}

/// Most replies fit into the kernel's buffer: then they leave at once. @returns how many bytes did
std::size_t Session::writeNow(std::string_view text) {
  progressed_ = wallTime();
  boost::system::error_code error;
  const std::size_t sent = socket_.write_some(boost::asio::buffer(text.data(), text.size()), error);
  return error ? 0 : sent;  // also if there is no room; write() reports real errors
}

/// Writes as much of the waiting output as there is room for now.
void Session::writeNow() {
  progressed_ = wallTime();
  boost::system::error_code error;
  const std::size_t sent = socket_.write_some(nextBuffers(), error);
  output_.take(error ? 0 : sent);
}

std::vector<boost::asio::const_buffer> Session::nextBuffers() {
  pieces_.clear();
  output_.look(kPiece, pieces_);
  std::vector<boost::asio::const_buffer> buffers;
  for (const std::string_view piece : pieces_) buffers.emplace_back(piece.data(), piece.size());
  return buffers;
}

void Session::write() {
  if (isWriting_ || isClosed_) return;
  if (output_.isEmpty()) {
    if (isFinishing_)
      listenToTheEnd();
    else
      host_.listen(*conversation_);
    return;
  }
  isWriting_ = true;
  socket_.async_write_some(
      nextBuffers(),
      [self = shared_from_this()](const boost::system::error_code& error, std::size_t count) {
        self->isWriting_ = false;
        if (error) {
          self->close();
          return;
        }
        self->progressed_ = wallTime();
        self->output_.take(count);
        self->write();
      });
}

void Session::finish() {
  isFinishing_ = true;
  finished_ = wallTime();
  if (!isClosed_) write();
}

/// Reads and drops what the client still sends until it closes, too: closing earlier would make the
/// kernel discard our last replies.
void Session::listenToTheEnd() {
  finished_ = wallTime();
  boost::system::error_code ignored;
  socket_.shutdown(boost::asio::socket_base::shutdown_send, ignored);
  read();
}

void Session::dismiss(const std::string& text) { conversation_->dismiss(text); }

void Session::look(Timestamp now) {
  if (isClosed_) return;
  const bool owes = isWriting_;
  const bool isDawdling = isFinishing_ && hasPassed(finished_, now, kLongestFarewell);
  if (owes && (isDawdling || hasPassed(progressed_, now, limits_.stall))) {
    close();  // it does not read, so it can't be told why
    return;
  }
  if (isFinishing_) {
    if (!owes && hasPassed(finished_, now, kFarewell)) close();
    return;
  }
  conversation_->look(now);
  if (hasEnded_) {
    if (!conversation_->hasOpenRequests()) finish();
    if (hasPassed(heard_, now, kFarewell + limits_.refusal)) close();
    return;
  }
  if (conversation_->isWaiting()) return;
  if (!conversation_->hasJoined() && hasPassed(started_, now, limits_.handshake)) {
    dismiss(lateHello(limits_));
  } else if (hasPassed(heard_, now, limits_.idle) && !conversation_->isSubscribed() &&
             !conversation_->hasOpenRequests()) {
    dismiss("ERR idle nothing came for " + std::to_string(static_cast<int>(limits_.idle)) + " s");
  }
}

void Session::close() {
  if (isClosed_) return;
  isClosed_ = true;
  conversation_->hangUp();
  boost::system::error_code ignored;
  socket_.shutdown(boost::asio::socket_base::shutdown_both, ignored);
  socket_.close(ignored);
  host_.forget(conversation_->id());
}

}  // namespace ortung::server

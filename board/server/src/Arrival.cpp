#include "Arrival.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>

#include "AddressKey.hpp"
#include "Http.hpp"

namespace ortung::server {
namespace {

constexpr double kFarewell = 2.0;  // time for a browser to close after our answer [s]

constexpr std::string_view kNoRoom =
    "There are too many visitors of this page at the moment: try again.\n";
constexpr std::string_view kNoWebServer =
    "This is a message board of Ortung, no web server. Its clients speak lines of text,\n"
    "beginning with HELLO ortung/1.\n";

}  // namespace

Porter::~Porter() = default;

Arrival::Arrival(boost::asio::ip::tcp::socket socket, Porter& porter, const BoardConfig& config,
                 ClientId id)
    : socket_(std::move(socket)),
      peer_(addressKey(socket_)),
      porter_(porter),
      config_(config),
      id_(id),
      started_(wallTime()) {}

void Arrival::read() {
  socket_.async_read_some(
      boost::asio::buffer(buffer_),
      [self = shared_from_this()](const boost::system::error_code& error, std::size_t count) {
        self->receive(error, count);
      });
}

void Arrival::receive(const boost::system::error_code& error, std::size_t count) {
  if (isGone_) return;
  const bool isAnswered = !answer_.empty();
  if (!error && !isAnswered) bytes_.append(buffer_.data(), count);
  if (isLate_) {
    porter_.dismiss(newcomer());
    return;
  }
  if (error) {
    close();
    return;
  }
  // Behind an answer all is dropped: closing while the peer still sends would discard the answer.
  const Speech speech = isAnswered ? Speech::kUnknown : speechOf(bytes_);
  if (speech == Speech::kHttp) {
    isHttp_ = true;
    receiveHead();
  } else if (speech == Speech::kOther) {
    porter_.enter(newcomer(), bytes_);
  } else {
    read();
  }
}

void Arrival::receiveHead() {
  const std::size_t length = httpHeadLength(bytes_);
  const std::size_t most = config_.limits.httpHead;
  if (!isHttpRequest(bytes_))
    answer("400 Bad Request", kNoWebServer);
  else if (std::min(length, bytes_.size()) > most)
    answer("431 Request Header Fields Too Large",
           "The head of a request has at most " + std::to_string(most) + " bytes.\n");
  else if (length != bytes_.npos && isTaken())
    return;
  else if (length != bytes_.npos && config_.http)
    answer("503 Service Unavailable", kNoRoom);
  else if (length != bytes_.npos)
    answer("501 Not Implemented", kNoWebServer);
  read();
}

/// Returns whether the board's host takes the connection.
bool Arrival::isTaken() {
  if (!config_.http) return false;
  boost::system::error_code error;
  const auto protocol = socket_.local_endpoint(error).protocol();
  if (!error) socket_.native_non_blocking(true, error);
  const int descriptor = error ? -1 : socket_.release(error);
  if (error) return false;
  try {
    isGone_ = config_.http({descriptor, bytes_, peer_, porter_.joinFor(peer_)});
  } catch (const std::exception& failure) {
    if (config_.log) config_.log(std::string("what takes web browsers failed: ") + failure.what());
  } catch (...) {
    if (config_.log) config_.log("what takes web browsers threw no std::exception");
  }
  if (isGone_)
    porter_.leave(id_);
  else
    socket_.assign(protocol, descriptor, error);
  return isGone_;
}

Newcomer Arrival::newcomer() {
  isGone_ = true;
  return {std::move(socket_), peer_, id_, started_};
}

void Arrival::answer(std::string_view status, std::string_view text) {
  answer_ = httpAnswer(bytes_, status, text);
  answered_ = wallTime();
  boost::asio::async_write(
      socket_, boost::asio::buffer(answer_),
      [self = shared_from_this()](const boost::system::error_code& error, std::size_t) {
        if (self->isGone_) return;
        boost::system::error_code ignored;
        if (!error) self->socket_.shutdown(boost::asio::socket_base::shutdown_send, ignored);
      });
}

void Arrival::look(Timestamp now) {
  if (isGone_ || isLate_) return;
  if (!answer_.empty()) {
    if (toSeconds(now - answered_) > kFarewell) close();
    return;
  }
  const BoardLimits& limits = config_.limits;
  if (toSeconds(now - started_) <= (isHttp_ ? limits.head : limits.handshake)) return;
  if (isHttp_) {
    answer("408 Request Timeout", "The head of the request did not come in time.\n");
    return;
  }
  isLate_ = true;
  boost::system::error_code ignored;
  socket_.cancel(ignored);  // then receive() has it dismissed
}

void Arrival::close() {
  if (isGone_) return;
  isGone_ = true;
  boost::system::error_code ignored;
  socket_.shutdown(boost::asio::socket_base::shutdown_both, ignored);
  socket_.close(ignored);
  porter_.leave(id_);
}

}  // namespace ortung::server

// Frames of WebSockets as the bridge reads them, of a client whose handshake was right. The first
// byte of the input says in pieces of which size the others come; the board says everything back.
#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <utility>

#include "Bridge.hpp"
#include "Pair.hpp"

namespace {

using namespace ortung;
using boost::asio::ip::tcp;

constexpr int kMostSteps = 100'000;     // that one input may cause
constexpr std::size_t kFarewell = 200;  // that of a connection, and a little more [bytes]

web::Request request() {
  namespace http = boost::beast::http;
  web::Request request(http::verb::get, "/board", 11);
  request.set(http::field::host, "localhost");
  request.set(http::field::connection, "Upgrade");
  request.set(http::field::upgrade, "websocket");
  request.set(http::field::sec_websocket_version, "13");
  request.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
  return request;
}

class Bridged {
 public:
  Bridged() {
    WebLimits limits;
    limits.message = 1024;
    tcp::socket socket(io_);
    socket.assign(tcp::v4(), client.take());
    bridge_ = std::make_shared<web::Bridge>(
        boost::beast::tcp_stream(std::move(socket)), board.take(), boardProtocol().make("/board"),
        web::Bridge::Way{"ortung.board.1", "here"}, limits, [this] { isOver = true; });
    bridge_->start(request());
    settle();
    const std::string agreed = std::exchange(toClient, {});
    fuzz::require(agreed.starts_with("HTTP/1.1 101 ") &&
                  agreed.find("ortung.board.1") != agreed.npos);
  }
  ~Bridged() {
    bridge_->close();
    settle();
  }
  Bridged(const Bridged&) = delete;
  Bridged& operator=(const Bridged&) = delete;

  /// Lets everything happen that can; the board says back what it hears.
  void settle() {
    for (bool isBusy = true; isBusy;) {
      io_.restart();
      isBusy = false;
      while (io_.poll_one() > 0) {
        fuzz::require(++steps_ < kMostSteps);
        isBusy = true;
      }
      const std::string said = board.heard();
      board.say(said);
      atBoard += said.size();
      toClient += client.heard();
    }
  }

  fuzz::Pair client;
  fuzz::Pair board;
  std::size_t atBoard = 0;
  std::string toClient;
  bool isOver = false;

 private:
  boost::asio::io_context io_;
  std::shared_ptr<web::Bridge> bridge_;
  int steps_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  const std::size_t piece = std::max<std::size_t>(1 + bytes[0], text.size() / fuzz::kMostPieces);
  Bridged bridged;
  for (std::size_t at = 0; at < text.size(); at += piece) {
    bridged.client.say(text.substr(at, piece));
    bridged.settle();
  }
  // Nothing grows on the way: each frame has six bytes beside those that the board gets.
  fuzz::require(bridged.atBoard <= text.size());
  fuzz::require(bridged.toClient.size() <= text.size() + kFarewell);
  bridged.client.end();
  bridged.settle();
  fuzz::require(bridged.isOver);
  return 0;
}

// What a browser, or who passes for one, says at the board's port: first to the board, then to the
// web's door. The first byte of the input says in pieces of which size the others come.
#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <optional>

#include "Arrival.hpp"
#include "Pair.hpp"
#include "Visit.hpp"

namespace {

using namespace ortung;
using boost::asio::ip::tcp;

constexpr int kMostSteps = 10'000;            // that one input may cause
constexpr std::size_t kLongestAnswer = 1000;  // [bytes]

/// Lets nobody in.
class Porter final : public server::Porter {
 public:
  ~Porter() override = default;
  void enter(server::Newcomer, std::string_view) override { isGone = true; }
  void dismiss(server::Newcomer) override { isGone = true; }
  std::function<int()> joinFor(const std::string&) override {
    return [] { return -1; };
  }
  void leave(server::ClientId) override { isGone = true; }
  bool isGone = false;
};

std::size_t count(std::string_view text, std::string_view word) {
  std::size_t number = 0;
  for (auto at = text.find(word); at != text.npos; at = text.find(word, at + word.size())) ++number;
  return number;
}

/// The port as it is before and behind the door, on one thread.
class Port {
 public:
  explicit Port(int socket)
      : config_(configOf()),
        page_({}, config_.limits.page),
        host_{page_, config_,
              [](boost::beast::tcp_stream&, const WebVisitor&, const web::Request&,
                 const web::Speaking&) { return false; }} {
    board_.http = [this](const HttpVisitor& visitor) { return take(visitor); };
    tcp::socket accepted(io_);
    accepted.assign(tcp::v4(), socket);
    arrival_ = std::make_shared<server::Arrival>(std::move(accepted), porter_, board_, 1);
    arrival_->start();
  }
  ~Port() {
    arrival_->close();
    if (visit_) visit_->close();
    settle();
  }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  void settle() {
    io_.restart();
    while (io_.poll_one() > 0) fuzz::require(++steps_ < kMostSteps);
  }
  bool isOver() const { return visit_ ? isVisitOver_ : porter_.isGone; }

 private:
  static WebConfig configOf() {
    WebConfig config;
    config.hosts = {"here"};
    return config;
  }
  bool take(const HttpVisitor& visitor) {
    tcp::socket taken(io_);
    taken.assign(tcp::v4(), visitor.socket);
    visit_ = std::make_shared<web::Visit>(
        std::move(taken), WebVisitor{visitor.socket, visitor.head, visitor.peer, visitor.join},
        host_, [this] { isVisitOver_ = true; });
    visit_->start();
    return true;
  }

  boost::asio::io_context io_;
  BoardConfig board_;
  WebConfig config_;
  web::Page page_;
  web::Visit::Host host_;
  Porter porter_;
  std::shared_ptr<server::Arrival> arrival_;
  std::shared_ptr<web::Visit> visit_;
  bool isVisitOver_ = false;
  int steps_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  const std::size_t piece = std::max<std::size_t>(1 + bytes[0], text.size() / fuzz::kMostPieces);
  fuzz::Pair pair;
  Port port(pair.take());
  std::string heard;
  for (std::size_t at = 0; at < text.size(); at += piece) {
    pair.say(text.substr(at, piece));
    port.settle();
    heard += pair.heard();
  }
  pair.end();
  for (int i = 0; i < 4; ++i) {
    port.settle();
    heard += pair.heard();
  }
  // An answer for each request at most, and one to what is none; then it is over.
  const std::size_t answers = count(heard, "HTTP/1.1 ") + count(heard, "HTTP/1.0 ");
  fuzz::require(answers <= count(text, "\n") + 1);
  fuzz::require(heard.size() <= answers * kLongestAnswer);
  fuzz::require(heard.empty() || heard.starts_with("HTTP/1."));
  fuzz::require(port.isOver());
  return 0;
}

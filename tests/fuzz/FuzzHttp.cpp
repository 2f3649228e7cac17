// What a browser, or who passes for one, says at the board's port: first to the board, then to the
// web's door. The first byte of the input says in pieces of which size the others come, and whether
// the door takes files.
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
constexpr std::uint64_t kLargestFile = 300;   // that the door takes [bytes]

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

/// Counts what comes, and what there is of it.
class CountedUpload final : public WebUpload {
 public:
  explicit CountedUpload(int& open) : open_(open) { fuzz::require(++open_ == 1); }
  ~CountedUpload() override { --open_; }
  CountedUpload(const CountedUpload&) = delete;
  CountedUpload& operator=(const CountedUpload&) = delete;
  std::optional<WebReply> take(std::string_view bytes) override {
    fuzz::require(!isWhole_ && !isRefused_);
    size_ += bytes.size();
    fuzz::require(size_ <= kLargestFile);
    isRefused_ = bytes.starts_with("no");
    if (isRefused_) return WebReply{507, "no room"};
    return std::nullopt;
  }
  void finish(std::function<void(WebReply)> answer) override {
    fuzz::require(!isWhole_ && !isRefused_);
    isWhole_ = true;
    answer({200, "it has " + std::to_string(size_) + " bytes"});
  }

 private:
  int& open_;
  std::uint64_t size_ = 0;
  bool isWhole_ = false;
  bool isRefused_ = false;
};

std::size_t count(std::string_view text, std::string_view word) {
  std::size_t number = 0;
  for (auto at = text.find(word); at != text.npos; at = text.find(word, at + word.size())) ++number;
  return number;
}

/// The port as it is before and behind the door, on one thread.
class Port {
 public:
  Port(int socket, bool takesFiles)
      : config_(configOf(takesFiles)),
        page_({}, config_.limits.page),
        host_{page_, config_,
              [](boost::beast::tcp_stream&, const WebVisitor&, const web::Request&,
                 const web::Speaking&) { return false; },
              std::make_shared<web::Later>(io_)} {
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
    fuzz::require(open_ == 0);
  }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  void settle() {
    io_.restart();
    while (io_.poll_one() > 0) fuzz::require(++steps_ < kMostSteps);
  }
  bool isOver() const { return visit_ ? isVisitOver_ : porter_.isGone; }

 private:
  WebConfig configOf(bool takesFiles) {
    WebConfig config;
    config.hosts = {"here"};
    if (!takesFiles) return config;
    config.uploads.most = kLargestFile;
    config.uploads.admits = [](std::string_view token) { return token == "abc"; };
    config.uploads.begin = [this](std::string_view target,
                                  WebReply&) -> std::unique_ptr<WebUpload> {
      fuzz::require(target.starts_with("/open"));
      if (target.ends_with("busy")) return nullptr;
      return std::make_unique<CountedUpload>(open_);
    };
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
  int open_ = 0;  ///< files that are being taken
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
  Port port(pair.take(), (bytes[0] & 1) != 0);
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

// Files that a page sends to the door of a message board, as Boost.Beast's client sends them.
#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <fstream>
#include <future>
#include <mutex>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "Files.hpp"
#include "RunningBoard.hpp"
#include "ortung/web/WebDoor.hpp"

namespace ortung {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using test::comesTrue;

constexpr const char* kToken = "12345678";

/// What has come of files; shared with the door's thread.
struct Kept {
  std::mutex mutex;
  std::string bytes;                     ///< of the last one
  std::string target;                    ///< what it was asked for with
  std::function<void(WebReply)> answer;  ///< of the one that waits for it
  std::atomic<int> open{0};              ///< uploads that exist
  std::atomic<int> whole{0};             ///< that came to their end
  bool answersLater = false;
  std::optional<WebReply> refusal;  ///< of the first bytes
};

class KeptUpload final : public WebUpload {
 public:
  explicit KeptUpload(Kept& kept) : kept_(kept) {
    ++kept_.open;
    kept_.bytes.clear();
  }
  ~KeptUpload() override { --kept_.open; }
  KeptUpload(const KeptUpload&) = delete;
  KeptUpload& operator=(const KeptUpload&) = delete;
  std::optional<WebReply> take(std::string_view bytes) override {
    const std::lock_guard lock(kept_.mutex);
    if (kept_.refusal) return kept_.refusal;
    kept_.bytes.append(bytes);
    return std::nullopt;
  }
  void finish(std::function<void(WebReply)> answer) override {
    const std::lock_guard lock(kept_.mutex);
    ++kept_.whole;
    if (kept_.answersLater)
      kept_.answer = std::move(answer);
    else
      answer({200, "got " + std::to_string(kept_.bytes.size())});
  }

 private:
  Kept& kept_;
};

class WebUploadTest : public testing::Test {
 protected:
  WebUploadTest() {
    std::ofstream(folder_.path() / "index.html") << "the page";
    config_.page = folder_.path();
    config_.uploads.most = 1'000'000;
    config_.uploads.admits = [](std::string_view token) { return token == kToken; };
    config_.uploads.begin = [this](std::string_view target,
                                   WebReply& refusal) -> std::unique_ptr<WebUpload> {
      const std::lock_guard lock(kept_.mutex);
      kept_.target = target;
      if (kept_.open == 0) return std::make_unique<KeptUpload>(kept_);
      refusal = {409, "busy"};
      return nullptr;
    };
  }
  void start() {
    door_.emplace(config_);
    boardConfig_.http = [this](const HttpVisitor& visitor) {
      return door_->take({visitor.socket, visitor.head, visitor.peer, visitor.join});
    };
    board_.emplace(world_, boardConfig_);
    host_ = "127.0.0.1:" + std::to_string(board_->port());
  }

  http::request<http::string_body> request(const std::string& body) const {
    http::request<http::string_body> made(http::verb::post, "/open?name=run.rec", 11);
    made.set(http::field::host, host_);
    made.set(http::field::origin, "http://" + host_);
    made.set(http::field::authorization, std::string("Bearer ") + kToken);
    made.body() = body;
    made.prepare_payload();
    return made;
  }
  tcp::socket connected() {
    tcp::socket socket(io_);
    socket.connect({asio::ip::make_address("127.0.0.1"), board_->port()});
    return socket;
  }
  static http::response<http::string_body> answerOn(tcp::socket& socket) {
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(socket, buffer, response);
    return response;
  }
  http::response<http::string_body> send(const http::request<http::string_body>& request) {
    tcp::socket socket = connected();
    http::write(socket, request);
    return answerOn(socket);
  }
  /// All that comes for bytes as they are, until the end.
  std::string sendBytes(const std::string& bytes) {
    tcp::socket socket = connected();
    asio::write(socket, asio::buffer(bytes));
    std::string all;
    beast::error_code error;
    asio::read(socket, asio::dynamic_buffer(all), error);
    return all;
  }
  std::string headOf(const std::string& more) const {
    return "POST /open?name=a HTTP/1.1\r\nHost: " + host_ + "\r\nAuthorization: Bearer " + kToken +
           "\r\n" + more + "\r\n\r\n";
  }

  test::TemporaryFolder folder_;
  Kept kept_;
  WebConfig config_;
  BoardConfig boardConfig_;
  test::CountingWorld world_{10};
  std::optional<WebDoor> door_;
  std::optional<test::RunningBoard> board_;
  std::string host_;
  asio::io_context io_;
};

TEST_F(WebUploadTest, TakesAFileWholeAndSaysWhatBecameOfIt) {
  start();
  std::string bytes(777'777, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i % 251);
  const auto response = send(request(bytes));
  EXPECT_EQ(response.result_int(), 200u);
  EXPECT_EQ(response.body(), "got 777777\n");
  EXPECT_EQ(kept_.bytes, bytes);
  EXPECT_EQ(kept_.target, "/open?name=run.rec");
  EXPECT_EQ(send(request("")).body(), "got 0\n");
  EXPECT_TRUE(comesTrue("no upload is open", [&] { return kept_.open == 0; }));
}

TEST_F(WebUploadTest, TakesAFileOfWhichNoLengthIsSaid) {
  start();
  const std::string answer =
      sendBytes(headOf("Transfer-Encoding: chunked") + "5\r\nhello\r\n6\r\n world\r\n0\r\n\r\n");
  EXPECT_TRUE(answer.ends_with("got 11\n")) << answer;
  EXPECT_EQ(kept_.bytes, "hello world");
}

TEST_F(WebUploadTest, SaysHowLargeAFileMayBe) {
  start();
  http::request<http::string_body> asked(http::verb::get, "/open", 11);
  asked.set(http::field::host, host_);
  EXPECT_EQ(send(asked).body(), "most=1000000\n");
}

TEST_F(WebUploadTest, TakesNoneFromStrangersOrStrangePages) {
  start();
  auto strange = request("x");
  strange.set(http::field::origin, "http://evil.example");
  EXPECT_EQ(send(strange).result_int(), 403u);
  strange.set(http::field::origin, "null");
  EXPECT_EQ(send(strange).result_int(), 403u);
  auto renamed = request("x");
  renamed.set(http::field::host, "evil.example");
  EXPECT_EQ(send(renamed).result_int(), 421u);
  for (const char* word : {"", "Bearer ", "Bearer 87654321", "Basic 12345678", "12345678"}) {
    auto guest = request("x");
    guest.set(http::field::authorization, word);
    EXPECT_EQ(send(guest).result_int(), 403u) << word;
  }
  auto silent = request("x");
  silent.erase(http::field::authorization);
  EXPECT_EQ(send(silent).result_int(), 403u);
  EXPECT_EQ(kept_.target, "");  // nobody was asked to take anything
  auto elsewhere = request("x");
  elsewhere.target("/");
  EXPECT_EQ(send(elsewhere).result_int(), 400u);
}

TEST_F(WebUploadTest, TakesNoMoreThanThereIsRoomFor) {
  start();
  EXPECT_TRUE(sendBytes(headOf("Content-Length: 1000001")).starts_with("HTTP/1.1 413 "));
  EXPECT_TRUE(
      sendBytes(headOf("Content-Length: 99999999999999999999999")).starts_with("HTTP/1.1 4"));
  EXPECT_EQ(kept_.target, "");
  // Of a file whose length is not said it shows in the end.
  std::string pieces;
  for (int i = 0; i < 17; ++i) pieces += "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
  const std::string answer = sendBytes(headOf("Transfer-Encoding: chunked") + pieces + "0\r\n\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 413 ")) << answer;
  EXPECT_EQ(kept_.whole, 0);
  EXPECT_TRUE(comesTrue("no upload is open", [&] { return kept_.open == 0; }));
}

TEST_F(WebUploadTest, ReadsOnWhatIsRefusedSoThatBrowsersHearWhy) {
  kept_.refusal = WebReply{507, "the disk is full"};
  start();
  const auto response = send(request(std::string(900'000, 'x')));
  EXPECT_EQ(response.result_int(), 507u);
  EXPECT_EQ(response.body(), "the disk is full\n");
  EXPECT_EQ(kept_.whole, 0);
}

TEST_F(WebUploadTest, OneIsTakenAtATime) {
  kept_.answersLater = true;
  start();
  tcp::socket first = connected();
  http::write(first, request("first"));
  ASSERT_TRUE(comesTrue("the file is whole", [&] { return kept_.whole == 1; }));
  EXPECT_EQ(send(request("second")).result_int(), 409u);
  {
    const std::lock_guard lock(kept_.mutex);
    kept_.answer({200, "in the end"});
  }
  EXPECT_EQ(answerOn(first).body(), "in the end\n");
  EXPECT_TRUE(comesTrue("no upload is open", [&] { return kept_.open == 0; }));
}

TEST_F(WebUploadTest, OfACutConnectionNothingIsLeft) {
  start();
  {
    tcp::socket socket = connected();
    asio::write(socket, asio::buffer(headOf("Content-Length: 500000") + std::string(300'000, 'x')));
    ASSERT_TRUE(comesTrue("an upload is open", [&] { return kept_.open == 1; }));
  }
  EXPECT_TRUE(comesTrue("no upload is open", [&] { return kept_.open == 0; }));
  EXPECT_EQ(kept_.whole, 0);
  EXPECT_EQ(send(request("again")).body(), "got 5\n");
}

TEST_F(WebUploadTest, WhoSendsNothingMoreIsGivenUp) {
  config_.uploads.patience = 0.05;
  start();
  const std::string answer = sendBytes(headOf("Content-Length: 10") + "abc");
  EXPECT_EQ(answer, "");
  EXPECT_TRUE(comesTrue("no upload is open", [&] { return kept_.open == 0; }));
}

TEST_F(WebUploadTest, AnAnswerMayComeWhenTheDoorIsGone) {
  kept_.answersLater = true;
  start();
  tcp::socket socket = connected();
  http::write(socket, request("x"));
  ASSERT_TRUE(comesTrue("the file is whole", [&] { return kept_.whole == 1; }));
  board_.reset();
  door_.reset();
  EXPECT_EQ(kept_.open, 0);
  kept_.answer({200, "too late"});
}

TEST_F(WebUploadTest, OtherRequestsAreAnsweredAsEver) {
  start();
  http::request<http::string_body> asked(http::verb::get, "/", 11);
  asked.set(http::field::host, host_);
  EXPECT_EQ(send(asked).body(), "the page");
  const std::string host = "Host: " + host_ + "\r\n";
  for (const std::string& wrong :
       {"POST / HTTP/1.1\r\n" + host + "Content-Length: 4\r\n\r\nabcd",
        "GET / HTTP/1.1\r\n" + host + "Content-Length: 1\r\n\r\n",
        "POST /open HTTP/1.1\r\n" + host +
            "Content-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n",
        "GET / HTTP/1.1\nHost: " + host_ + "\n\n", std::string("GET /\r\n\r\n")}) {
    const std::string answer = sendBytes(wrong);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400 Bad Request\r\n")) << wrong << answer;
    EXPECT_EQ(answer.find("HTTP/1.1", 1), std::string::npos) << answer;
  }
}

}  // namespace
}  // namespace ortung

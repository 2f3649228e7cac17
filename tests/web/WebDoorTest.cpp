// A message board with a door for browsers, as they see it: Boost.Beast's client.
#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <fstream>
#include <thread>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "Files.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/web/WebDoor.hpp"

namespace ortung {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using test::comesTrue;

/// A board with a page whose index says "the page".
class WebDoorTest : public testing::Test {
 protected:
  WebDoorTest() {
    std::ofstream(folder_.path() / "index.html") << "the page";
    webConfig_.page = folder_.path();
    boardConfig_ = test::controlledConfig();
  }
  void start() {
    door_.emplace(webConfig_);
    boardConfig_.http = [this](const HttpVisitor& visitor) {
      return door_->take({visitor.socket, visitor.head, visitor.peer, visitor.join});
    };
    board_.emplace(world_, boardConfig_);
    host_ = "127.0.0.1:" + std::to_string(board_->port());
  }
  tcp::endpoint endpoint() const { return {asio::ip::make_address("127.0.0.1"), board_->port()}; }

  /// Connects from an address of this computer.
  void connect(tcp::socket& socket, const std::string& from = "127.0.0.1") const {
    socket.open(tcp::v4());
    socket.bind({asio::ip::make_address(from), 0});
    socket.connect(endpoint());
  }
  std::string requestOf(const std::string& target) const {
    return "GET " + target + " HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n";
  }
  /// All that comes until the end of the connection.
  static std::string restOf(tcp::socket& socket) {
    std::string all;
    beast::error_code error;
    asio::read(socket, asio::dynamic_buffer(all), error);
    return all;
  }
  /// Asks for a file on a connection that stays open. @returns the status
  unsigned ask(tcp::socket& socket, const std::string& target = "/") const {
    asio::write(socket, asio::buffer(requestOf(target)));
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(socket, buffer, response);
    return response.result_int();
  }
  /// A file that no buffers of sockets can hold.
  void makeLargeFile() const {
    std::ofstream(folder_.path() / "large") << std::string(15u << 20, 'x');
  }

  http::response<http::string_body> get(const std::string& target, const std::string& host = "",
                                        http::verb verb = http::verb::get) {
    tcp::socket socket(io_);
    socket.connect(endpoint());
    http::request<http::empty_body> request(verb, target, 11);
    request.set(http::field::host, host.empty() ? host_ : host);
    http::write(socket, request);
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.skip(verb == http::verb::head);
    http::read(socket, buffer, parser);
    return parser.release();
  }

  using WebSocket = websocket::stream<tcp::socket>;
  void speak(WebSocket& client, const std::string& origin = "",
             const std::string& from = "127.0.0.1") {
    connect(client.next_layer(), from);
    client.set_option(websocket::stream_base::decorator([=](websocket::request_type& request) {
      request.set(http::field::sec_websocket_protocol, "ortung.board.1");
      if (!origin.empty()) request.set(http::field::origin, origin);
    }));
    client.binary(true);
    websocket::response_type response;
    client.handshake(response, host_, "/board");
    EXPECT_EQ(response[http::field::sec_websocket_protocol], "ortung.board.1");
  }
  /// The answer to somebody who asks for a WebSocket.
  unsigned statusOf(const std::string& origin, const std::string& protocol,
                    const std::string& path) {
    tcp::socket socket(io_);
    socket.connect(endpoint());
    http::request<http::empty_body> request(http::verb::get, path, 11);
    request.set(http::field::host, host_);
    request.set(http::field::connection, "Upgrade");
    request.set(http::field::upgrade, "websocket");
    request.set(http::field::sec_websocket_version, "13");
    request.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
    if (!protocol.empty()) request.set(http::field::sec_websocket_protocol, protocol);
    if (!origin.empty()) request.set(http::field::origin, origin);
    http::write(socket, request);
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(socket, buffer, response);
    return response.result_int();
  }
  /// Reads until a line contains @p text.
  std::string lineWith(WebSocket& client, const std::string& text) {
    while (true) {
      const std::size_t found = heard_.find(text);
      const std::size_t end = found == heard_.npos ? found : heard_.find('\n', found);
      if (end != heard_.npos) {
        const std::size_t begin = heard_.rfind('\n', found);
        const std::string line =
            heard_.substr(begin == heard_.npos ? 0 : begin + 1, end - (begin + 1));
        heard_.erase(0, end + 1);
        return line;
      }
      beast::flat_buffer buffer;
      beast::error_code error;
      client.read(buffer, error);
      if (error) return "(closed)";
      heard_ += beast::buffers_to_string(buffer.data());
    }
  }
  void say(WebSocket& client, const std::string& text) { client.write(asio::buffer(text)); }

  test::TemporaryFolder folder_;
  WebConfig webConfig_;
  BoardConfig boardConfig_;
  test::CountingWorld world_{10'000};
  std::optional<WebDoor> door_;
  std::optional<test::RunningBoard> board_;
  std::string host_;
  std::string heard_;
  asio::io_context io_;
};

TEST_F(WebDoorTest, GivesThePageToBrowsersAndTheBoardToClients) {
  start();
  const auto response = get("/");
  EXPECT_EQ(response.result(), http::status::ok);
  EXPECT_EQ(response.body(), "the page");
  EXPECT_EQ(response["X-Content-Type-Options"], "nosniff");
  EXPECT_NE(response["Content-Security-Policy"].find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(get("/index.html", "", http::verb::head)[http::field::content_length], "8");
  EXPECT_EQ(get("/none").result(), http::status::not_found);
  EXPECT_EQ(get("/", "", http::verb::delete_).result(), http::status::method_not_allowed);
  EXPECT_EQ(get("/", "evil.example").result(), http::status::misdirected_request);
}

TEST_F(WebDoorTest, CarriesTheBoardsOwnWordsOverAWebSocket) {
  start();
  WebSocket client(io_);
  speak(client, "http://" + host_);
  say(client, "HELLO ortung/1 name=view\n#7 CREATE scout\n" + test::kAnyRobot + ".\n");
  EXPECT_EQ(lineWith(client, "HELLO").substr(0, 40), "OK HELLO ortung/1 client=2 role=operator");
  EXPECT_EQ(lineWith(client, "CREATE"), "#7 OK CREATE robot=1 features=2");
  say(client, "LOCKSTEP on\n#8 NEXT form=binary\n");
  const std::string reply = lineWith(client, "#8 OK NEXT");
  const std::size_t bytes = std::stoul(reply.substr(reply.find("bytes=") + 6));
  EXPECT_GT(bytes, 40'000u);  // an image of 10,000 words
  while (heard_.size() < bytes) {
    beast::flat_buffer buffer;
    client.read(buffer);
    heard_ += beast::buffers_to_string(buffer.data());
  }
  EXPECT_EQ(heard_.size(), bytes);
}

TEST_F(WebDoorTest, RefusesWebSocketsOfStrangePagesPathsAndProtocols) {
  webConfig_.origins = {"https://friend.example"};
  start();
  EXPECT_EQ(statusOf("http://evil.example", "ortung.board.1", "/board"), 403u);
  EXPECT_EQ(statusOf("null", "ortung.board.1", "/board"), 403u);
  EXPECT_EQ(statusOf("", "ortung.board.1", "/"), 400u);
  EXPECT_EQ(statusOf("", "chat", "/board"), 400u);
  EXPECT_EQ(statusOf("", "", "/board"), 400u);
  EXPECT_EQ(statusOf("https://friend.example", "chat, ortung.board.1", "/board"), 101u);
}

TEST_F(WebDoorTest, LimitsOfTheBoardHoldForBrowsers) {
  start();
  WebSocket client(io_);
  speak(client);
  say(client, "HELLO ortung/1\n" + std::string(100u << 10, 'x'));
  EXPECT_EQ(lineWith(client, "* ERR"), "* ERR line a line is longer than 65536 bytes");
  EXPECT_EQ(lineWith(client, "anything"), "(closed)");
  WebSocket bomb(io_);
  speak(bomb);
  beast::error_code error;
  bomb.write(asio::buffer(std::string(1u << 20, '\n')), error);
  EXPECT_EQ(lineWith(bomb, "anything"), "(closed)");
}

TEST_F(WebDoorTest, ClientsWithoutTheTokenMayLookButNotControl) {
  boardConfig_ = BoardConfig();
  boardConfig_.tokens = {{"view", "12345678"}};
  boardConfig_.control = {"view"};
  boardConfig_.guests = true;
  boardConfig_.limits.refusal = 0.01;
  start();
  WebSocket owner(io_);
  speak(owner);
  say(owner, "HELLO ortung/1 name=view token=12345678\nPAUSE\n");
  EXPECT_NE(lineWith(owner, "HELLO").find("role=operator"), std::string::npos);
  EXPECT_EQ(lineWith(owner, "PAUSE").substr(0, 8), "OK PAUSE");
  heard_.clear();
  WebSocket guest(io_);
  speak(guest);
  say(guest, "HELLO ortung/1 name=guest\nRESUME\n");
  EXPECT_NE(lineWith(guest, "HELLO").find("role=player"), std::string::npos);
  EXPECT_EQ(lineWith(guest, "RESUME").substr(0, 8), "ERR role");
  heard_.clear();
  WebSocket thief(io_);
  speak(thief);
  say(thief, "HELLO ortung/1 name=view token=87654321\n");
  EXPECT_EQ(lineWith(thief, "ERR"), "* ERR token it is missing or wrong");
}

TEST_F(WebDoorTest, ViewersThatNeverReadCostNoMemoryAndOthersGoOn) {
  boardConfig_ = BoardConfig();
  boardConfig_.pace = Pace::kFree;
  start();
  WebSocket driver(io_);
  speak(driver);
  say(driver, "HELLO ortung/1 name=driver\nCREATE scout\n" + test::kAnyRobot + ".\n");
  lineWith(driver, "CREATE");
  std::vector<std::unique_ptr<WebSocket>> silent;
  for (int i = 0; i < 20; ++i) {
    silent.push_back(std::make_unique<WebSocket>(io_));
    speak(*silent.back());
    say(*silent.back(), "HELLO ortung/1 role=viewer\nSUBSCRIBE robot=1 form=binary\n");
  }
  // They are sent 40 kB a cycle: far more than there is room for in any socket.
  for (int i = 0; i < 50; ++i) {
    say(driver, "NEXT\n");  // refused, as it is not in lockstep: an exchange
    lineWith(driver, "ERR state");
  }
  say(driver, "STATUS\n");
  EXPECT_NE(lineWith(driver, "STATUS").find("state=running"), std::string::npos);
  EXPECT_EQ(door_->connections(), 21u);
}

TEST_F(WebDoorTest, ARequestThatIsNotUnderstoodIsAnsweredOnceAndTheLast) {
  start();
  const std::string host = "Host: " + host_ + "\r\n";
  for (const std::string& request :
       {"POST / HTTP/1.1\r\n" + host + "Content-Length: 3\r\nContent-Length: 4\r\n\r\nabcd",
        "POST / HTTP/1.1\r\n" + host + "Content-Length: 4\r\n\r\nabcd",
        "GET / HTTP/1.1\r\n" + host + "Content-Length: 1\r\n\r\n",  // is not waited for
        "POST / HTTP/1.1\r\n" + host + "Content-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n",
        "GET / HTTP/1.1\nHost: " + host_ + "\n\n", std::string("GET /\r\n\r\n"),
        "GET / HTTP/1.1\r\n" + host + "nonsense\r\n\r\n" + requestOf("/")}) {
    SCOPED_TRACE(request);
    tcp::socket socket(io_);
    connect(socket);
    asio::write(socket, asio::buffer(request));
    const std::string answer = restOf(socket);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400 Bad Request\r\n")) << answer;
    EXPECT_NE(answer.find("\r\nConnection: close\r\n"), std::string::npos) << answer;
    EXPECT_EQ(answer.find("HTTP/1.1", 1), std::string::npos) << answer;
  }
}

TEST_F(WebDoorTest, AHeadRequestGetsNoBodyEvenIfItIsRefused) {
  start();
  tcp::socket socket(io_);
  connect(socket);
  const std::string head = "HEAD /none HTTP/1.1\r\nHost: " + host_ + "\r\n";
  asio::write(socket, asio::buffer(head + "\r\n" + head + "Connection: close\r\n\r\n"));
  const std::string answers = restOf(socket);
  EXPECT_EQ(answers.find("There is no such file"), std::string::npos) << answers;
  EXPECT_NE(answers.find("HTTP/1.1 404", 1), std::string::npos) << answers;
}

TEST_F(WebDoorTest, AConnectionEndsAfterAHundredRequests) {
  start();
  tcp::socket socket(io_);
  connect(socket);
  std::string requests;
  for (int i = 0; i < 105; ++i) requests += requestOf("/");
  asio::write(socket, asio::buffer(requests));
  const std::string answers = restOf(socket);
  std::size_t number = 0;
  for (std::size_t at = answers.find("HTTP/1.1 200"); at != answers.npos;
       at = answers.find("HTTP/1.1 200", at + 1))
    ++number;
  EXPECT_EQ(number, 100u);
}

TEST_F(WebDoorTest, WhoHasAskedForNothingMoreMakesRoomForOthers) {
  webConfig_.limits.connections = 4;
  webConfig_.limits.connectionsOfAddress = 2;
  webConfig_.limits.pause = 60.0;
  start();
  std::vector<std::unique_ptr<tcp::socket>> kept;
  for (int i = 0; i < 3; ++i)
    for (const char* from : {"127.0.0.2", "127.0.0.3", "127.0.0.4"}) {
      kept.push_back(std::make_unique<tcp::socket>(io_));
      connect(*kept.back(), from);
      EXPECT_EQ(ask(*kept.back()), 200u);
    }
  for (int i = 0; i < 5; ++i) EXPECT_EQ(get("/").body(), "the page");
}

TEST_F(WebDoorTest, WhoFindsNoRoomIsToldAndOthersAreNot) {
  makeLargeFile();
  webConfig_.limits.connectionsOfAddress = 2;
  start();
  std::vector<std::unique_ptr<tcp::socket>> busy;
  for (int i = 0; i < 2; ++i) {
    busy.push_back(std::make_unique<tcp::socket>(io_));
    connect(*busy.back(), "127.0.0.2");
    asio::write(*busy.back(), asio::buffer(requestOf("/large")));
    char first = '\0';
    asio::read(*busy.back(), asio::buffer(&first, 1));  // it is being answered
  }
  tcp::socket third(io_);
  connect(third, "127.0.0.2");
  asio::write(third, asio::buffer(requestOf("/")));
  const std::string answer = restOf(third);
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 503 Service Unavailable\r\n")) << answer;
  EXPECT_EQ(get("/").body(), "the page");
}

TEST_F(WebDoorTest, WebSocketsOfOneComputerTakeNobodyElsesPlace) {
  webConfig_.limits.socketsOfAddress = 3;
  boardConfig_.limits.sessionsOfAddress = 2;
  start();
  std::vector<std::unique_ptr<WebSocket>> many;
  for (int i = 0; i < 3; ++i) {
    many.push_back(std::make_unique<WebSocket>(io_));
    speak(*many.back(), "", "127.0.0.2");
    say(*many.back(), "HELLO ortung/1\n");
    heard_.clear();
    EXPECT_EQ(lineWith(*many.back(), " "),
              i < 2 ? "OK HELLO ortung/1 client=" + std::to_string(2 * i + 2) +
                          " role=operator kind=simulation world=counting now=0 state=waiting"
                    : "* ERR limit there are 2 clients from 127.0.0.2 already");
  }
  heard_.clear();
  EXPECT_EQ(statusOf("", "ortung.board.1", "/board"), 101u);
  EXPECT_TRUE(test::TestClient(board_->port()).ask("HELLO ortung/1").starts_with("OK HELLO"));
}

TEST_F(WebDoorTest, OneWebSocketTooManyIsTold) {
  webConfig_.limits.socketsOfAddress = 1;
  start();
  WebSocket client(io_);
  speak(client);
  EXPECT_EQ(statusOf("", "ortung.board.1", "/board"), 503u);
}

/// Answers each message with more than there is room for in any socket.
class Talker final : public WebSpeech {
 public:
  explicit Talker(std::atomic<int>& heard) : heard_(heard) {}
  ~Talker() override = default;
  void fromClient(std::string_view, bool) override {
    ++heard_;
    toClient.push_back({std::string(15u << 20, 'x'), true});
  }
  void fromBoard(std::string_view) override {}

 private:
  std::atomic<int>& heard_;
};

TEST_F(WebDoorTest, WhoDoesNotReadItsAnswersIsNotHeardAndThenGone) {
  std::atomic<int> heard{0};
  webConfig_.protocols = {{{"ortung.board.1"}, "/board", [&](std::string_view) {
                             return std::make_unique<Talker>(heard);
                           }}};
  webConfig_.limits.patience = 0.1;
  start();
  WebSocket client(io_);
  speak(client);
  beast::error_code error;
  for (int i = 0; i < 10; ++i) client.write(asio::buffer("again", 5), error);
  EXPECT_TRUE(comesTrue("who reads nothing is gone", [&] { return door_->connections() == 0; }));
  EXPECT_EQ(heard, 1);
}

TEST_F(WebDoorTest, ALongMessageThatIsReadInPiecesArrivesWhole) {
  std::atomic<int> heard{0};
  webConfig_.protocols = {{{"ortung.board.1"}, "/board", [&](std::string_view) {
                             return std::make_unique<Talker>(heard);
                           }}};
  start();
  WebSocket client(io_);
  client.read_message_max(32u << 20);
  speak(client);
  for (int i = 1; i <= 2; ++i) {
    say(client, "more");
    beast::flat_buffer buffer;
    client.read(buffer);
    EXPECT_EQ(buffer.size(), 15u << 20);
    EXPECT_EQ(heard, i);
  }
}

TEST_F(WebDoorTest, EndsWithItsConnections) {
  start();
  WebSocket client(io_);
  speak(client);
  say(client, "HELLO ortung/1 name=view\n");
  lineWith(client, "HELLO");
  board_.reset();
  EXPECT_EQ(lineWith(client, "BYE"), "* BYE the server ends");
  EXPECT_EQ(lineWith(client, "anything"), "(closed)");
  door_.reset();
}

}  // namespace
}  // namespace ortung

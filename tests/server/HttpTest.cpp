// What speaks HTTP to the board's port.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>

#include "CountingWorld.hpp"
#include "Http.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"

namespace ortung::test {
namespace {

const std::string kGet = "GET /page HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";

TEST(Http, AConnectionIsJudgedByItsFirstBytes) {
  using server::Speech;
  using server::speechOf;
  for (const char* http :
       {"GET ", "GET / HTTP/1.1\r\n", "POST /x", "HEAD /", "OPTIONS *", "PRI * "})
    EXPECT_EQ(speechOf(http), Speech::kHttp) << http;
  for (const char* other :
       {"HELLO ortung/1", "HELP", "#1 GET ", "get / ", "GETS", "\n", "\x16\x03"})
    EXPECT_EQ(speechOf(other), Speech::kOther) << other;
  for (const char* unknown : {"", "G", "GET", "HE", "H"})
    EXPECT_EQ(speechOf(unknown), Speech::kUnknown) << unknown;
}

TEST(Http, AHeadEndsWithAnEmptyLine) {
  EXPECT_EQ(server::httpHeadLength("GET / HTTP/1.0\r\n\r\nbody"), 18u);
  EXPECT_EQ(server::httpHeadLength("GET / HTTP/1.0\n\nbody\r\n\r\n"), 16u);
  EXPECT_EQ(server::httpHeadLength("GET / HTTP/1.0\r\n"), std::string::npos);
}

TEST(Http, ABrowserIsToldThatThisIsNoWebServer) {
  CountingWorld world;
  const RunningBoard board(world, {});
  for (const std::string& request :
       {kGet, std::string("POST /x HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\nHELLO ortung/1\nSTATUS\n")}) {
    TestClient client(board.port());
    client.send(request);
    const std::string answer = client.rest();
    const std::size_t body = answer.find("\r\n\r\n") + 4;
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 501 Not Implemented\r\n")) << answer;
    EXPECT_NE(answer.find("\r\nConnection: close\r\n"), std::string::npos);
    EXPECT_NE(answer.find("\r\nContent-Length: " + std::to_string(answer.size() - body) + "\r\n"),
              std::string::npos);
    EXPECT_NE(answer.find("no web server", body), std::string::npos);
    EXPECT_EQ(answer.find("OK HELLO"), std::string::npos);
  }
}

TEST(Http, AHeadRequestIsAnsweredWithoutABody) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.send("HEAD / HTTP/1.1\r\n\r\n");
  EXPECT_TRUE(client.rest().ends_with("Connection: close\r\n\r\n"));
}

TEST(Http, ALineOfAHeadWithoutItsRequestIsRefusedAtOnce) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.send("Host: evil\r\nHELLO ortung/1\n");
  EXPECT_TRUE(client.rest().starts_with("HTTP/1.1 400 Bad Request\r\n"));
}

TEST(Http, HeadsThatAreTooLongOrTooLateAreRefused) {
  CountingWorld world;
  // Each on a board that is impatient of this alone: a busy machine may hold up any of them.
  const auto answer = [&](const char* beginning, const BoardLimits& limits) {
    BoardConfig config;
    config.limits = limits;
    const RunningBoard board(world, config);
    TestClient client(board.port());
    client.send(beginning);
    return client.rest();
  };
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(answer("GET / HTTP/1.1\r\n", {.head = 0.2}).starts_with("HTTP/1.1 408 "));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(200));
  const std::string large = "GET /" + std::string(2000, 'x');
  EXPECT_TRUE(answer(large.c_str(), {.httpHead = 1000}).starts_with("HTTP/1.1 431 "));
  // Neither this nor that.
  EXPECT_EQ(answer("HE", {.handshake = 0.2}), "* ERR hello it did not come within 0 s\n");
}

TEST(Http, ABeginningThatComesInPiecesIsTheProtocolAllTheSame) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  for (const char* piece : {"H", "E", "LL", "O ortung/1\nSTA"}) client.send(piece);
  EXPECT_TRUE(client.line().starts_with("OK HELLO"));
  EXPECT_TRUE(client.ask("TUS").starts_with("OK STATUS"));
}

TEST(Http, WhoeverHostsTheBoardMayTakeTheConnection) {
  CountingWorld world;
  BoardConfig config;
  std::string taken;
  config.http = [&](const HttpVisitor& visitor) {
    if (!visitor.head.starts_with("GET /page ")) return false;
    taken = visitor.head;
    const int socket = visitor.socket;
    const std::string answer = "HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\nhi";
    EXPECT_EQ(::send(socket, answer.data(), answer.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(answer.size()));
    ::close(socket);
    return true;
  };
  {
    const RunningBoard board(world, config);
    TestClient client(board.port());
    client.send(kGet.substr(0, 20));
    client.send(kGet.substr(20));
    EXPECT_EQ(client.rest(), "HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\nhi");
    TestClient other(board.port());
    other.send("GET /else HTTP/1.1\r\n\r\n");
    EXPECT_TRUE(other.rest().starts_with("HTTP/1.1 503 "));
    EXPECT_TRUE(TestClient(board.port()).ask("HELLO ortung/1").starts_with("OK HELLO"));
  }
  EXPECT_EQ(taken, kGet);  // the board's threads have ended
}

TEST(Http, AFailureOfWhoeverTakesItHarmsNobody) {
  CountingWorld world;
  BoardConfig config;
  config.http = [](const HttpVisitor&) -> bool { throw std::runtime_error("no page"); };
  std::string told;
  config.log = [&](const std::string& text) { told = text; };
  {
    const RunningBoard board(world, config);
    TestClient client(board.port());
    client.send(kGet);
    EXPECT_TRUE(client.rest().starts_with("HTTP/1.1 503 "));
  }
  EXPECT_EQ(told, "what takes web browsers failed: no page");
}

}  // namespace
}  // namespace ortung::test

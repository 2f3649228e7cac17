#include "ortung/web/WebDoor.hpp"

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <map>
#include <optional>
#include <thread>

#include "Bridge.hpp"
#include "Page.hpp"
#include "Visit.hpp"

namespace ortung {

namespace asio = boost::asio;
using asio::ip::tcp;

struct WebDoor::Parts {
  explicit Parts(const WebConfig& given)
      : config(given),
        page(config.page, config.limits.page),
        host{
            page, config,
            [this](boost::beast::tcp_stream stream, const web::Request& request,
                   const web::Speaking& speaking) { speak(std::move(stream), request, speaking); }},
        thread([this] { run(); }) {}

  ~Parts() {
    asio::post(io, [this] {
      isEnding = true;
      const auto all = std::exchange(visits, {});
      const auto talking = std::exchange(bridges, {});
      for (const auto& [id, visit] : all) visit->close();
      for (const auto& [id, bridge] : talking) bridge->close();
      work.reset();
    });
    thread.join();
  }

  /// What one connection throws is not the others' end.
  void run() {
    while (true) {
      try {
        io.run();
        return;
      } catch (const std::exception& error) {
        if (config.log) config.log(std::string("a web connection failed: ") + error.what());
      }
    }
  }

  void admit(int descriptor, const std::string& head) {
    tcp::socket socket(io);
    boost::system::error_code error;
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    const bool isSix =
        ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length) == 0 &&
        address.ss_family == AF_INET6;
    socket.assign(isSix ? tcp::v6() : tcp::v4(), descriptor, error);
    if (error || isEnding) {
      ::close(descriptor);
      --count;
      return;
    }
    const std::uint64_t id = ++last;
    const auto visit = std::make_shared<web::Visit>(std::move(socket), head, host,
                                                    [this, id] { forget(visits, id); });
    visits[id] = visit;
    visit->start();
  }

  void speak(boost::beast::tcp_stream stream, const web::Request& request,
             const web::Speaking& speaking) {
    const std::uint64_t id = ++last;
    ++count;
    const auto bridge = std::make_shared<web::Bridge>(
        std::move(stream),
        speaking.protocol->make(std::string_view(request.target().data(), request.target().size())),
        speaking.name, config.limits, [this, id] { forget(bridges, id); });
    bridges[id] = bridge;
    bridge->start(request, board);
  }

  /// Later: whoever says so is still at work.
  template <typename Connections>
  void forget(Connections& connections, std::uint64_t id) {
    asio::post(io, [this, &connections, id] {
      connections.erase(id);
      --count;
    });
  }

  const WebConfig config;
  const web::Page page;
  const web::Visit::Host host;
  asio::io_context io{1};
  std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work{
      asio::make_work_guard(io)};
  tcp::endpoint board;
  std::map<std::uint64_t, std::shared_ptr<web::Visit>> visits;
  std::map<std::uint64_t, std::shared_ptr<web::Bridge>> bridges;
  std::uint64_t last = 0;
  bool isEnding = false;
  std::atomic<std::size_t> count{0};
  std::thread thread;  ///< last, so that it ends before what it uses
};

WebDoor::WebDoor(const WebConfig& config) : parts_(std::make_unique<Parts>(config)) {}
WebDoor::~WebDoor() = default;

bool WebDoor::hasPage() const { return parts_->page.isThere(); }

void WebDoor::open(const std::string& address, std::uint16_t port) {
  const tcp::endpoint board(asio::ip::make_address(address), port);
  asio::post(parts_->io, [parts = parts_.get(), board] { parts->board = board; });
}

bool WebDoor::take(int socket, const std::string& head) {
  if (parts_->count >= parts_->config.limits.connections) return false;
  ++parts_->count;
  asio::post(parts_->io, [parts = parts_.get(), socket, head] { parts->admit(socket, head); });
  return true;
}

std::size_t WebDoor::connections() const { return parts_->count; }

}  // namespace ortung

#include "ortung/web/WebDoor.hpp"

#include <algorithm>
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

namespace {

constexpr std::size_t kMostWaiting = 256;  // connections taken that were not looked at yet
constexpr std::size_t kMostLeaving = 64;   // connections that have their last answer

}  // namespace

struct WebDoor::Parts {
  explicit Parts(const WebConfig& given)
      : config(given),
        page(config.page, config.limits.page),
        host{page, config,
             [this](boost::beast::tcp_stream& stream, const WebVisitor& visitor,
                    const web::Request& request, const web::Speaking& speaking) {
               return speak(stream, visitor, request, speaking);
             },
             std::make_shared<web::Later>(io)},
        thread([this] { run(); }) {}

  ~Parts() {
    host.later->end();
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

  void admit(const WebVisitor& visitor) {
    --waiting;
    const int descriptor = visitor.socket;
    tcp::socket socket(io);
    boost::system::error_code error;
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    const bool isSix =
        ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length) == 0 &&
        address.ss_family == AF_INET6;
    socket.assign(isSix ? tcp::v6() : tcp::v4(), descriptor, error);
    if (error || isEnding) {
      if (error) ::close(descriptor);
      --count;
      return;
    }
    const bool hasRoom = makeRoom(visitor.peer);
    const std::uint64_t id = ++last;
    const auto visit = std::make_shared<web::Visit>(std::move(socket), visitor, host,
                                                    [this, id] { forget(visits, id); });
    visits[id] = visit;
    hasRoom ? visit->start() : visit->refuse();
  }

  /// Has one go that waits for nothing, if that is needed. @returns whether there is room then
  bool makeRoom(const std::string& peer) {
    const auto isLeaving = [](const auto& visit) { return visit.isLeaving(); };
    if (number(isLeaving) >= kMostLeaving) closeOldest(isLeaving);
    const auto isServed = [](const auto& visit) { return visit.isServed(); };
    const auto isOfPeer = [&](const auto& visit) {
      return visit.isServed() && visit.peer() == peer;
    };
    if (number(isOfPeer) >= config.limits.connectionsOfAddress)
      return closeOldest([&](const auto& visit) { return visit.isIdle() && visit.peer() == peer; });
    return number(isServed) < config.limits.connections ||
           closeOldest([](const auto& visit) { return visit.isIdle(); });
  }

  /// How many visits are such.
  template <typename Is>
  std::size_t number(const Is& is) const {
    return static_cast<std::size_t>(std::count_if(
        visits.begin(), visits.end(), [&](const auto& entry) { return is(*entry.second); }));
  }

  /// Closes the visit that has been such for longest. @returns whether there was one
  template <typename Is>
  bool closeOldest(const Is& is) {
    std::shared_ptr<web::Visit> oldest;
    for (const auto& [id, visit] : visits)
      if (is(*visit) && (!oldest || visit->since() < oldest->since())) oldest = visit;
    if (oldest) oldest->close();
    return oldest != nullptr;
  }

  bool speak(boost::beast::tcp_stream& stream, const WebVisitor& visitor,
             const web::Request& request, const web::Speaking& speaking) {
    const auto ofPeer = std::count_if(bridges.begin(), bridges.end(), [&](const auto& entry) {
      return entry.second->peer() == visitor.peer;
    });
    if (bridges.size() >= config.limits.sockets ||
        static_cast<std::size_t>(ofPeer) >= config.limits.socketsOfAddress)
      return false;
    const int board = visitor.join ? visitor.join() : -1;
    if (board < 0) return false;
    const std::uint64_t id = ++last;
    ++count;
    const auto bridge = std::make_shared<web::Bridge>(
        std::move(stream), board,
        speaking.protocol->make(std::string_view(request.target().data(), request.target().size())),
        web::Bridge::Way{speaking.name, visitor.peer}, config.limits,
        [this, id] { forget(bridges, id); });
    bridges[id] = bridge;
    bridge->start(request);
    return true;
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
  asio::io_context io{1};
  const web::Visit::Host host;
  std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work{
      asio::make_work_guard(io)};
  std::map<std::uint64_t, std::shared_ptr<web::Visit>> visits;
  std::map<std::uint64_t, std::shared_ptr<web::Bridge>> bridges;
  std::uint64_t last = 0;
  bool isEnding = false;
  std::atomic<std::size_t> count{0};
  std::atomic<std::size_t> waiting{0};  ///< of them, those that were not looked at yet
  std::thread thread;                   ///< last, so that it ends before what it uses
};

WebDoor::WebDoor(const WebConfig& config) : parts_(std::make_unique<Parts>(config)) {}
WebDoor::~WebDoor() = default;

bool WebDoor::hasPage() const { return parts_->page.isThere(); }

bool WebDoor::take(const WebVisitor& visitor) {
  if (parts_->waiting >= kMostWaiting) return false;
  ++parts_->waiting;
  ++parts_->count;
  asio::post(parts_->io, [parts = parts_.get(), visitor] { parts->admit(visitor); });
  return true;
}

std::size_t WebDoor::connections() const { return parts_->count; }

}  // namespace ortung

#include "ortung/server/MessageBoard.hpp"

#include <algorithm>
#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <chrono>
#include <deque>
#include <future>
#include <system_error>
#include <thread>

#include "AddressKey.hpp"
#include "Arrival.hpp"
#include "BoardChecks.hpp"
#include "Session.hpp"

namespace ortung {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using server::Arrival;
using server::Session;

constexpr int kBacklog = 128;
constexpr std::chrono::seconds kLongestFarewell{1};
// Longest time spent on many clients before requests of others are handled.
constexpr Timestamp kTimeOfTurn = 300;  // [us]
// Pauses between turns of clients that have sent more than one turn can handle.
constexpr Timestamp kShortestPause = 50;     // [us]
constexpr Timestamp kLongestPause = 10'000;  // [us]
constexpr Timestamp kPausePerTurn = 2;       // pause as a multiple of the turn's time

void checkAddress(const BoardConfig& config) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  boost::system::error_code error;
  const auto address = asio::ip::make_address(config.address, error);
  if (error)
    refuse("the address to listen on is '" + config.address +
           "', expected numbers, e.g. 127.0.0.1 or ::1");
  if (!address.is_loopback() && (config.tokens.empty() || config.guests))
    refuse(config.address + " can be reached from other computers: that needs a token");
}

}  // namespace

/// The board's parts: what accepts connections, and the host of the conversations.
struct MessageBoard::Parts final : server::Host, server::Porter {
  Parts(ServedWorld& world, const BoardConfig& boardConfig)
      : Host(world, boardConfig, keeper_),
        keeper_(world, boardConfig, [this] { onCycle(); }),
        acceptor_(io_),
        timer_(io_) {}
  ~Parts() override = default;

  void post(std::function<void()> task) override { asio::post(io_, std::move(task)); }

  void work(std::function<void()> task) override { asio::post(workers_, std::move(task)); }

  void workLong(std::function<void()> task) override { asio::post(slow_, std::move(task)); }

  void queue(std::weak_ptr<server::Conversation> client) override {
    backlog_.push_back(std::move(client));
    if (backlog_.size() == 1) awaitTurn();
  }

  void awaitTurn() {
    turnTimer_.expires_at(nextTurn_);  // if that has passed, it runs at once, but in order
    turnTimer_.async_wait([this](const boost::system::error_code& cancelled) {
      if (!cancelled && !isEnding_) giveTurn();
    });
  }

  void giveTurn() {
    const auto begin = std::chrono::steady_clock::now();
    const std::weak_ptr<server::Conversation> first = std::move(backlog_.front());
    backlog_.pop_front();
    const bool hasOthers = !backlog_.empty();
    if (const auto client = first.lock()) client->nextTurn();
    const auto end = std::chrono::steady_clock::now();
    nextTurn_ = end + std::clamp<std::chrono::steady_clock::duration>(
                          kPausePerTurn * (end - begin), std::chrono::microseconds(kShortestPause),
                          std::chrono::microseconds(kLongestPause));
    if (hasOthers) awaitTurn();  // otherwise clients that were queued meanwhile have called it
  }

  void broadcast(server::ClientId from, std::string_view text) override {
    for (const auto& [id, session] : sessions_)
      if (id != from) session->conversation().tell(text);
  }

  void spread(server::ClientId from, std::string_view text) override {
    for (const auto& [id, session] : sessions_)
      if (id != from) session->conversation().hear(text);
    haveTalkHeard();
  }

  std::size_t listeners(server::ClientId from) const override {
    return static_cast<std::size_t>(
        std::count_if(sessions_.begin(), sessions_.end(), [&](const auto& entry) {
          return entry.first != from && entry.second->conversation().hasJoined();
        }));
  }

  void listen(server::Conversation& client) override {
    if (client.hasTalk()) haveTalkHeard();
  }

  void haveTalkHeard() {
    if (!std::exchange(isTalkPosted_, true)) post([this] { letHear(0); });
  }

  /// Lets clients behind @p last hear what others have sent.
  void letHear(server::ClientId last) {
    const Timestamp begin = server::wallTime();
    for (auto next = sessions_.upper_bound(last); next != sessions_.end(); ++next) {
      if (next->second->conversation().hearOn()) hasMoreTalk_ = true;
      if (server::wallTime() - begin < kTimeOfTurn) continue;
      post([this, id = next->first] { letHear(id); });
      return;
    }
    isTalkPosted_ = false;
    if (std::exchange(hasMoreTalk_, false)) haveTalkHeard();
  }

  void forget(server::ClientId client) override {
    // This happens later: the session that calls is still at work, and maybe a loop over all
    // sessions.
    post([this, client] { sessions_.erase(client); });
  }

  void countSubscribers(int change) override { subscribers_ += change; }

  /// Runs on the world's thread.
  void onCycle() {
    if (subscribers_ == 0 || isTickPosted_.exchange(true)) return;
    asio::post(io_, [this] { push(0); });
  }

  /// Sends subscribed readings to clients behind @p last.
  void push(server::ClientId last) {
    if (last == 0) isTickPosted_ = false;  // later readings need another round
    const Timestamp begin = server::wallTime();
    for (auto next = sessions_.upper_bound(last); next != sessions_.end(); ++next) {
      next->second->conversation().onCycle();
      if (server::wallTime() - begin < kTimeOfTurn) continue;
      asio::post(io_, [this, id = next->first] { push(id); });
      return;
    }
  }

  void listen() {
    const tcp::endpoint endpoint(asio::ip::make_address(config.address), config.port);
    try {
      acceptor_.open(endpoint.protocol());
      acceptor_.set_option(tcp::acceptor::reuse_address(true));
      acceptor_.bind(endpoint);
      acceptor_.listen(kBacklog);
    } catch (const boost::system::system_error& error) {
      throw std::runtime_error("can't listen on " + config.address + " port " +
                               std::to_string(config.port) + ": " + error.code().message());
    }
    port_ = acceptor_.local_endpoint().port();
    accept();
    look();
  }

  void accept() {
    acceptor_.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (!error) {
        admit(std::move(socket));
        accept();
        return;
      }
      log("a client could not be accepted: " + error.message());
      // Most likely there are too many open files: give other clients time to leave.
      retry_.expires_after(std::chrono::milliseconds(100));
      retry_.async_wait([this](const boost::system::error_code& cancelled) {
        if (!cancelled && !isEnding_) accept();
      });
    });
  }

  void admit(tcp::socket socket) {
    const server::ClientId id = ++lastClient_;
    const BoardLimits& limits = config.limits;
    const bool isFull = sessions_.size() + arrivals_.size() >= limits.sessions;
    const std::string peer = server::addressKey(socket);
    if (isFull || count(peer) >= limits.sessionsOfAddress) {
      const auto session =
          std::make_shared<Session>(std::move(socket), *this, id, server::wallTime());
      sessions_[id] = session;
      session->dismiss("ERR limit there are " +
                       std::to_string(isFull ? limits.sessions : limits.sessionsOfAddress) +
                       " clients " + (isFull ? "" : "from " + peer + " ") + "already");
      return;
    }
    const auto arrival = std::make_shared<Arrival>(std::move(socket), *this, config, id);
    arrivals_[id] = arrival;
    arrival->start();
  }

  /// Returns how many connections come from a computer.
  std::size_t count(const std::string& peer) const {
    const auto isThere = [&](const auto& entry) { return entry.second->peer() == peer; };
    return static_cast<std::size_t>(std::count_if(sessions_.begin(), sessions_.end(), isThere) +
                                    std::count_if(arrivals_.begin(), arrivals_.end(), isThere));
  }

  void enter(tcp::socket socket, server::ClientId id, Timestamp since,
             std::string_view bytes) override {
    arrivals_.erase(id);
    const auto session = std::make_shared<Session>(std::move(socket), *this, id, since);
    sessions_[id] = session;
    session->start(bytes);
  }

  void leave(server::ClientId id) override {
    post([this, id] { arrivals_.erase(id); });  // later: a loop over all may be under way
  }

  /// Checks the time limits of all connections, periodically.
  void look() {
    const BoardLimits& limits = config.limits;
    const double shortest = std::max(
        0.01, std::min({limits.handshake, limits.idle, limits.stall, limits.refusal, 1.0}));
    timer_.expires_after(std::chrono::microseconds(fromSeconds(shortest / 4.0)));
    timer_.async_wait([this](const boost::system::error_code& cancelled) {
      if (cancelled || isEnding_) return;
      const Timestamp now = server::wallTime();
      for (const auto& [id, arrival] : arrivals_) arrival->look(now);
      for (const auto& [id, session] : sessions_) session->look(now);
      look();
    });
  }

  void log(const std::string& text) const {
    if (config.log) config.log(text);
  }

  void shutDown(const std::string& why) {
    isEnding_ = true;  // a timer that has expired already can't be cancelled
    boost::system::error_code ignored;
    acceptor_.close(ignored);
    timer_.cancel();
    retry_.cancel();
    turnTimer_.cancel();
    for (const auto& [id, arrival] : arrivals_) arrival->close();
    arrivals_.clear();
    for (const auto& [id, session] : sessions_) {
      session->dismiss("BYE " + why);
      session->close();
    }
    sessions_.clear();
  }

  server::WorldKeeper keeper_;
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer timer_;
  asio::steady_timer retry_{io_};
  std::map<server::ClientId, std::shared_ptr<Arrival>> arrivals_;
  std::map<server::ClientId, std::shared_ptr<Session>> sessions_;
  server::ClientId lastClient_ = 0;
  std::uint16_t port_ = 0;
  bool isEnding_ = false;
  std::atomic<int> subscribers_{0};
  std::atomic<bool> isTickPosted_{false};
  std::deque<std::weak_ptr<server::Conversation>> backlog_;
  asio::steady_timer turnTimer_{io_};
  std::chrono::steady_clock::time_point nextTurn_;
  bool isTalkPosted_ = false;
  bool hasMoreTalk_ = false;
  asio::thread_pool workers_{1};  ///< last, so that threads end before what they work on
  asio::thread_pool slow_{1};
};

MessageBoard::MessageBoard(ServedWorld& world, const BoardConfig& config) {
  checkAddress(config);
  server::checkBoard(config, world);
  parts_ = std::make_unique<Parts>(world, config);
  parts_->listen();
}

MessageBoard::~MessageBoard() = default;

std::uint16_t MessageBoard::port() const { return parts_->port_; }

void MessageBoard::run(const std::function<bool()>& goesOn) {
  std::thread clients;
  try {
    clients = std::thread([this] { parts_->io_.run(); });
  } catch (const std::system_error& error) {
    throw std::runtime_error(std::string("the thread that talks to clients can't be made: ") +
                             error.what());
  }
  const auto end = [&] {
    parts_->keeper_.haltCommanded();
    asio::post(parts_->io_, [this] { parts_->shutDown("the server ends"); });
    clients.join();
  };
  try {
    parts_->keeper_.run(goesOn);
  } catch (...) {
    end();
    throw;
  }
  end();
}

void MessageBoard::stop() { parts_->keeper_.stop(); }

bool MessageBoard::abandon(const std::string& why) {
  const auto done = std::make_shared<std::promise<void>>();
  std::future<void> told = done->get_future();
  asio::post(parts_->io_, [this, why, done] {
    parts_->shutDown(why);
    done->set_value();
  });
  return told.wait_for(kLongestFarewell) == std::future_status::ready;
}

BoardStatistics MessageBoard::statistics() const { return parts_->keeper_.statistics(); }

}  // namespace ortung

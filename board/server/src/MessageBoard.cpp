#include "ortung/server/MessageBoard.hpp"

#include <algorithm>
#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <chrono>
#include <deque>
#include <future>
#include <system_error>
#include <thread>

#include "BoardChecks.hpp"
#include "Entrance.hpp"
#include "Scheduling.hpp"
#include "Session.hpp"
#include "SlowWork.hpp"
#include "ortung/server/Patience.hpp"

namespace ortung {
namespace {

namespace asio = boost::asio;
using server::Newcomer;
using server::Session;

// Those who are told why they may not come in, at a time; more are told nothing.
constexpr std::size_t kMostRefused = 64;
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
struct MessageBoard::Parts final : server::Host {
  Parts(ServedWorld& world, const BoardConfig& boardConfig)
      : Host(world, boardConfig, keeper_),
        keeper_(world, boardConfig, [this] { onCycle(); }),
        entrance_(io_, config,
                  {[this](Newcomer newcomer, std::string_view bytes) {
                     enter(std::move(newcomer), bytes);
                   },
                   [this](Newcomer newcomer) {
                     refuse(std::move(newcomer), server::lateHello(config.limits));
                   }}),
        timer_(io_),
        slow_(boardConfig.limits.slowShare) {}
  ~Parts() override = default;

  void post(std::function<void()> task) override { asio::post(io_, std::move(task)); }

  void work(std::function<void()> task) override { asio::post(workers_, std::move(task)); }

  void workLong(server::ClientId client, server::SlowTask task) override {
    slow_.give(client, std::move(task));
  }
  void paceLong() override { slow_.pace(); }

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
    post([this, client] {
      sessions_.erase(client);
      refused_.erase(client);
    });
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

  void enter(Newcomer newcomer, std::string_view bytes) {
    const BoardLimits& limits = config.limits;
    const bool isCrowd = count(newcomer.peer) >= limits.sessionsOfAddress;
    const bool isFull = sessions_.size() >= limits.sessions;
    if ((isCrowd || isFull) && !displace(isCrowd ? newcomer.peer : "")) {
      const std::string whose = isFull ? "" : "from " + newcomer.peer + " ";
      refuse(std::move(newcomer),
             "ERR limit there are " +
                 std::to_string(isFull ? limits.sessions : limits.sessionsOfAddress) + " clients " +
                 whose + "already");
      return;
    }
    const server::ClientId id = newcomer.id;
    const auto session = std::make_shared<Session>(std::move(newcomer), *this);
    sessions_[id] = session;
    session->start(bytes);
  }

  /// Takes the place of the oldest of those that have not said HELLO, so that who says nothing of
  /// use keeps nobody out. @param peer of which computer; "": any @returns whether there was one
  bool displace(const std::string& peer) {
    const auto found = std::find_if(sessions_.begin(), sessions_.end(), [&](const auto& entry) {
      const Session& session = *entry.second;
      return !session.hasJoined() && (peer.empty() || session.peer() == peer);
    });
    if (found == sessions_.end()) return false;
    const std::shared_ptr<Session> session = found->second;
    sessions_.erase(found);
    session->close();
    return true;
  }

  /// Tells somebody why it may not come in. It is no client, so it takes no client's place.
  void refuse(Newcomer newcomer, const std::string& why) {
    if (refused_.size() >= kMostRefused) return;
    const server::ClientId id = newcomer.id;
    const auto session = std::make_shared<Session>(std::move(newcomer), *this);
    refused_[id] = session;
    session->dismiss(why);
  }

  /// Returns how many clients come from a computer.
  std::size_t count(const std::string& peer) const {
    return static_cast<std::size_t>(
        std::count_if(sessions_.begin(), sessions_.end(),
                      [&](const auto& entry) { return entry.second->peer() == peer; }));
  }

  /// Checks the time limits of all connections, periodically.
  void look() {
    const BoardLimits& limits = config.limits;
    const double shortest = std::max(0.01, std::min({limits.handshake, limits.head, limits.idle,
                                                     limits.stall, limits.refusal, 1.0}));
    timer_.expires_after(std::chrono::microseconds(fromSeconds(shortest / 4.0)));
    timer_.async_wait([this](const boost::system::error_code& cancelled) {
      if (cancelled || isEnding_) return;
      const Timestamp now = server::wallTime();
      entrance_.look(now);
      for (const auto* all : {&sessions_, &refused_})
        for (const auto& [id, session] : *all) session->look(now);
      look();
    });
  }

  void shutDown(const std::string& why) {
    isEnding_ = true;  // a timer that has expired already can't be cancelled
    entrance_.close();
    timer_.cancel();
    turnTimer_.cancel();
    for (const auto& [id, session] : sessions_) {
      session->dismiss("BYE " + why);
      session->close();
    }
    for (const auto& [id, session] : refused_) session->close();
    sessions_.clear();
    refused_.clear();
  }

  server::WorldKeeper keeper_;
  asio::io_context io_{1};
  server::Entrance entrance_;
  asio::steady_timer timer_;
  std::map<server::ClientId, std::shared_ptr<Session>> sessions_;
  std::map<server::ClientId, std::shared_ptr<Session>> refused_;  ///< see refuse()
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
  server::SlowWork slow_;
};

MessageBoard::MessageBoard(ServedWorld& world, const BoardConfig& config) {
  checkAddress(config);
  server::checkBoard(config, world);
  parts_ = std::make_unique<Parts>(world, config);
  parts_->port_ = parts_->entrance_.listen();
  parts_->look();
}

MessageBoard::~MessageBoard() = default;

std::uint16_t MessageBoard::port() const { return parts_->port_; }

void MessageBoard::run(const std::function<bool()>& goesOn) {
  std::thread clients;
  try {
    clients = std::thread([this] {
      server::comeForward();
      parts_->io_.run();
    });
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
    const Patience patience(Patience::kWorld);
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

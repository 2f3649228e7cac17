#include "ortung/refbox/RefBoxClient.hpp"

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>

#include "Budget.hpp"
#include "Messages.hpp"
#include "ortung/refbox/BoxCommand.hpp"

namespace ortung::refbox {
namespace {

using boost::asio::ip::tcp;
using Error = boost::system::error_code;

constexpr int kMostEvents = 64;      ///< events per poll(), so that no box holds up the caller
constexpr int kMostMessages = 32;    ///< messages per poll()
constexpr int kMostComplaints = 20;  ///< complaints reported per connection
// A referee's hand is slower; what comes faster waits in the network.
constexpr double kOrdersAtOnce = 100.0;
constexpr double kOrders = 2.0;  ///< [1/s]
// What a person is told, over all connections: a box may come and go for as long as it likes.
constexpr double kLinesAtOnce = 60.0;
constexpr double kLines = 0.1;         ///< [1/s]
constexpr std::size_t kBuffer = 4096;  ///< [bytes]

void need(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("RefBoxConfig: " + what);
}

bool isTime(double value) { return std::isfinite(value) && value >= 0.0; }

}  // namespace

void RefBoxConfig::check() const {
  need(!host.empty(), "host is empty");
  need(port != 0, "port is 0");
  need(!ownTeam.empty() && !otherTeam.empty() && ownTeam != otherTeam,
       "ownTeam and otherTeam must be two names");
  need(isTime(reportPeriod) && reportPeriod >= 0.01, "reportPeriod must be at least 0.01 s");
  need(isTime(retry), "retry must be a time in seconds");
  need(isTime(connectTimeout) && connectTimeout > 0.0, "connectTimeout must be above 0 s");
  need(longestMessage >= 64 && longestMessage <= (std::size_t{1} << 24),
       "longestMessage must be from 64 bytes to 16 MiB");
}

struct RefBoxClient::Impl {
  enum class State { kIdle, kConnecting, kConnected };

  RefBoxConfig config;
  std::function<WorldState()> worldState;
  std::function<void(const std::string&)> order;
  std::function<void(const std::string&)> tell;

  boost::asio::io_context io;
  tcp::resolver resolver{io};
  std::shared_ptr<tcp::socket> socket;  ///< this connection's socket; its handlers share it
  State state = State::kIdle;
  std::uint64_t connection = 0;  ///< counts them: what an old one still has to say is not heard
  double now = 0.0;
  double next = 0.0;      ///< attempt to connect, or end of one
  double report = 0.0;    ///< next
  std::string complaint;  ///< last one of connecting, which is not repeated
  int complaints = 0;
  Messages messages{0};
  std::deque<std::string> waiting;  ///< messages that were not taken yet
  Budget orders{kOrdersAtOnce, kOrders};
  Budget lines{kLinesAtOnce, kLines};
  std::size_t unsaid = 0;   ///< lines that were not told since the last one
  bool isWaitTold = false;  ///< that this connection sends orders too fast
  bool isReading = false;
  BoxTeams teams;
  bool isWelcome = false;
  std::array<char, kBuffer> buffer{};
  bool isWriting = false;

  std::string server() const { return config.host + ":" + std::to_string(config.port); }

  void connect() {
    state = State::kConnecting;
    socket = std::make_shared<tcp::socket>(io);
    isWriting = false;
    next = now + config.connectTimeout;
    const auto id = ++connection;
    resolver.async_resolve(
        config.host, std::to_string(config.port),
        [this, id](const Error& error, const tcp::resolver::results_type& found) {
          if (id != connection) return;
          if (error) return lose("has no address: " + error.message());
          boost::asio::async_connect(*socket, found,
                                     [this, id, own = socket](const Error& e, const auto&) {
                                       if (id != connection) return;
                                       if (e) return lose("can't be reached: " + e.message());
                                       start();
                                     });
        });
  }

  void start() {
    Error ignored;
    socket->set_option(tcp::no_delay(true), ignored);
    state = State::kConnected;
    report = now;
    complaint.clear();
    complaints = 0;
    messages.reset();
    waiting.clear();
    isWaitTold = false;
    isWelcome = false;
    teams = {config.ownTeam, config.otherTeam, config.address};
    say("connected to the RefBox " + server());
    read();
  }

  void lose(const std::string& why) {
    ++connection;
    Error ignored;
    resolver.cancel();
    if (socket) socket->close(ignored);
    state = State::kIdle;
    next = now + config.retry;
    if (why != complaint) say("the RefBox " + server() + " " + why);
    complaint = why;
  }

  /// Only while nothing waits, so what the box sends too fast stays with it.
  void read() {
    isReading = true;
    socket->async_read_some(
        boost::asio::buffer(buffer),
        [this, id = connection, own = socket](const Error& error, std::size_t count) {
          if (id != connection) return;
          isReading = false;
          if (error) return lose("is gone: " + error.message());
          receive({buffer.data(), count});
          if (waiting.empty()) read();
        });
  }

  void receive(std::string_view bytes) {
    messages.receive(
        bytes, [this](std::string_view message) { waiting.emplace_back(message); },
        [this] {
          complain("a message is longer than " + std::to_string(config.longestMessage) +
                   " bytes, it is passed over");
        });
  }

  /// Takes what waits, as far as that may be done now.
  void takeOn() {
    const auto id = connection;
    for (int i = 0; i < kMostMessages && !waiting.empty(); ++i) {
      if (!take(waiting.front())) return;
      if (id != connection) return;
      waiting.pop_front();
    }
    if (waiting.empty() && !isReading && state == State::kConnected) read();
  }

  /// @returns whether it was taken; otherwise it has to wait
  bool take(std::string_view message) {
    std::string why;
    const auto command = readBoxCommand(message, why);
    if (!command) return complain("a message makes no sense: " + why);
    if (command->command == "WELCOME") {
      isWelcome = true;
      if (config.address.empty()) teams.address = command->targetTeam;
    }
    if (command->command == "RESET" && !isWelcome)
      return complain("it does not know this team's address");
    const auto text = orderOf(*command, teams, why);
    if (!text) return complain(why);
    if (text->empty()) return true;
    if (!orders.take(now)) {
      if (!std::exchange(isWaitTold, true))
        complain("its commands come too fast, they are taken as slowly as a referee gives them");
      return false;
    }
    try {
      order(*text);
    } catch (const std::invalid_argument& error) {
      complain(error.what());
    }
    return true;
  }

  /// @returns that the message is done with
  bool complain(const std::string& what) {
    if (++complaints > kMostComplaints) return true;
    say("the RefBox " + server() + ": " + what);
    if (complaints == kMostComplaints)
      say("the RefBox " + server() + ": further nonsense of this connection is not told");
    return true;
  }

  void say(const std::string& line) {
    if (!lines.take(now)) {
      ++unsaid;
      return;
    }
    const std::size_t missing = std::exchange(unsaid, 0);
    tell(missing == 0 ? line
                      : line + " (" + std::to_string(missing) + " lines before were not told)");
  }

  void tellState() {
    report = now + config.reportPeriod;
    if (isWriting) return;  // the box reads too slowly: it gets a later one
    isWriting = true;
    auto text = std::make_shared<std::string>(toJson(worldState()));
    text->push_back('\0');
    boost::asio::async_write(
        *socket, boost::asio::buffer(*text),
        [this, id = connection, own = socket, text](const Error& error, std::size_t) {
          if (id != connection) return;
          isWriting = false;
          if (error) lose("is gone: " + error.message());
        });
  }
};

RefBoxClient::RefBoxClient(const RefBoxConfig& config, std::function<WorldState()> state,
                           std::function<void(const std::string&)> order,
                           std::function<void(const std::string&)> tell)
    : impl_(std::make_unique<Impl>()) {
  config.check();
  impl_->config = config;
  impl_->worldState = std::move(state);
  impl_->order = std::move(order);
  impl_->tell = std::move(tell);
  impl_->messages = Messages(config.longestMessage);
  impl_->teams = {config.ownTeam, config.otherTeam, config.address};
  impl_->next = -std::numeric_limits<double>::infinity();
}

RefBoxClient::~RefBoxClient() = default;

void RefBoxClient::poll(double now) {
  Impl& i = *impl_;
  i.now = now;
  if (i.state == Impl::State::kIdle && now >= i.next) i.connect();
  if (i.state == Impl::State::kConnecting && now >= i.next) i.lose("does not answer");
  if (i.state == Impl::State::kConnected && now >= i.report) i.tellState();
  i.io.restart();
  for (int event = 0; event < kMostEvents && i.io.poll_one() != 0; ++event) {
  }
  if (i.state == Impl::State::kConnected) i.takeOn();
}

bool RefBoxClient::isConnected() const { return impl_->state == Impl::State::kConnected; }

const std::string& RefBoxClient::address() const { return impl_->teams.address; }

}  // namespace ortung::refbox

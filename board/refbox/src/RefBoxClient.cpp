#include "ortung/refbox/RefBoxClient.hpp"

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "Messages.hpp"
#include "ortung/refbox/BoxCommand.hpp"

namespace ortung::refbox {
namespace {

using boost::asio::ip::tcp;
using Error = boost::system::error_code;

constexpr int kMostEvents = 64;        ///< events per poll(), so that no box holds up the caller
constexpr int kMostComplaints = 20;    ///< complaints reported per connection
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
    isWelcome = false;
    teams = {config.ownTeam, config.otherTeam, config.address};
    tell("connected to the RefBox " + server());
    read();
  }

  void lose(const std::string& why) {
    ++connection;
    Error ignored;
    resolver.cancel();
    if (socket) socket->close(ignored);
    state = State::kIdle;
    next = now + config.retry;
    if (why != complaint) tell("the RefBox " + server() + " " + why);
    complaint = why;
  }

  void read() {
    socket->async_read_some(
        boost::asio::buffer(buffer),
        [this, id = connection, own = socket](const Error& error, std::size_t count) {
          if (id != connection) return;
          if (error) return lose("is gone: " + error.message());
          receive({buffer.data(), count});
          read();
        });
  }

  void receive(std::string_view bytes) {
    messages.receive(
        bytes, [this](std::string_view message) { take(message); },
        [this] {
          complain("a message is longer than " + std::to_string(config.longestMessage) +
                   " bytes, it is passed over");
        });
  }

  void take(std::string_view message) {
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
    if (text->empty()) return;
    try {
      order(*text);
    } catch (const std::invalid_argument& error) {
      complain(error.what());
    }
  }

  void complain(const std::string& what) {
    if (++complaints > kMostComplaints) return;
    tell("the RefBox " + server() + ": " + what);
    if (complaints == kMostComplaints)
      tell("the RefBox " + server() + ": further nonsense of this connection is not told");
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
}

bool RefBoxClient::isConnected() const { return impl_->state == Impl::State::kConnected; }

const std::string& RefBoxClient::address() const { return impl_->teams.address; }

}  // namespace ortung::refbox

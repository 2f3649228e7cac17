#include "Entrance.hpp"

#include <algorithm>
#include <boost/asio/local/connect_pair.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "AddressKey.hpp"

namespace ortung::server {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

constexpr int kBacklog = 128;
constexpr std::chrono::milliseconds kRetry{100};
constexpr Timestamp kComplaintPeriod = 10'000'000;  // [us]

}  // namespace

/// What joins of other threads pass: they may come when the board is gone.
struct Entrance::Gate {
  std::mutex mutex;
  Entrance* entrance = nullptr;  ///< null: nobody comes in any more
};

Entrance::Entrance(asio::io_context& io, const BoardConfig& config, Ways ways)
    : io_(io),
      config_(config),
      ways_(std::move(ways)),
      gate_(std::make_shared<Gate>()),
      acceptor_(io),
      retry_(io) {
  gate_->entrance = this;
}

Entrance::~Entrance() = default;

std::uint16_t Entrance::listen() {
  const tcp::endpoint endpoint(asio::ip::make_address(config_.address), config_.port);
  try {
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(tcp::acceptor::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen(kBacklog);
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error("can't listen on " + config_.address + " port " +
                             std::to_string(config_.port) + ": " + error.code().message());
  }
  accept();
  return acceptor_.local_endpoint().port();
}

void Entrance::accept() {
  acceptor_.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
    if (isClosed_) return;
    if (!error) {
      admit(std::move(socket));
      accept();
      return;
    }
    complain("a client could not be accepted: " + error.message());
    // Most likely there are too many open files: give other clients time to leave.
    retry_.expires_after(kRetry);
    retry_.async_wait([this](const boost::system::error_code& cancelled) {
      if (!cancelled && !isClosed_) accept();
    });
  });
}

void Entrance::admit(tcp::socket socket) {
  const ClientId id = ++last_;
  const auto arrival = std::make_shared<Arrival>(std::move(socket), *this, config_, id);
  makeRoom(arrival->peer());
  arrivals_[id] = arrival;
  arrival->start();
}

/// Has the oldest go if there is no room for one more: who means to say something does so at once.
void Entrance::makeRoom(const std::string& peer) {
  std::map<std::string, std::size_t> counts;
  for (const auto& [id, arrival] : arrivals_) ++counts[arrival->peer()];
  std::string crowd = peer;
  if (counts[peer] < config_.limits.sessionsOfAddress) {
    if (arrivals_.size() < config_.limits.sessions) return;
    crowd = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
              return a.second < b.second;
            })->first;
  }
  const auto oldest = std::find_if(arrivals_.begin(), arrivals_.end(), [&](const auto& entry) {
    return entry.second->peer() == crowd;
  });
  if (oldest == arrivals_.end()) return;
  const std::shared_ptr<Arrival> gone = oldest->second;
  arrivals_.erase(oldest);
  gone->close();
}

void Entrance::enter(Newcomer newcomer, std::string_view bytes) {
  arrivals_.erase(newcomer.id);
  ways_.enter(std::move(newcomer), bytes);
}

void Entrance::dismiss(Newcomer newcomer) {
  arrivals_.erase(newcomer.id);
  ways_.dismiss(std::move(newcomer));
}

void Entrance::leave(ClientId id) {
  // Later: a loop over all may be under way.
  asio::post(io_, [gate = gate_, id] {
    if (gate->entrance != nullptr) gate->entrance->arrivals_.erase(id);
  });
}

std::function<int()> Entrance::joinFor(const std::string& peer) {
  return [gate = gate_, peer] {
    const std::lock_guard lock(gate->mutex);
    return gate->entrance == nullptr ? -1 : gate->entrance->join(peer);
  };
}

/// Runs on any thread, while the gate is open.
int Entrance::join(const std::string& peer) {
  using asio::local::stream_protocol;
  stream_protocol::socket ours(io_);
  stream_protocol::socket theirs(io_);
  boost::system::error_code error;
  asio::local::connect_pair(ours, theirs, error);
  if (!error) theirs.native_non_blocking(true, error);
  const int descriptor = error ? -1 : theirs.release(error);
  if (error) return -1;
  asio::post(io_, [this, peer, socket = std::move(ours)]() mutable {
    if (!isClosed_) ways_.enter({std::move(socket), peer, ++last_, wallTime()}, "");
  });
  return descriptor;
}

void Entrance::look(Timestamp now) {
  for (const auto& [id, arrival] : arrivals_) arrival->look(now);
}

void Entrance::close() {
  if (std::exchange(isClosed_, true)) return;
  {
    const std::lock_guard lock(gate_->mutex);
    gate_->entrance = nullptr;
  }
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  retry_.cancel();
  for (const auto& [id, arrival] : std::exchange(arrivals_, {})) arrival->close();
}

void Entrance::complain(const std::string& what) {
  const Timestamp now = wallTime();
  if (!config_.log || (complained_ != 0 && now - complained_ < kComplaintPeriod)) return;
  complained_ = now;
  config_.log(what);
}

}  // namespace ortung::server

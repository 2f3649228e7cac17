#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "Arrival.hpp"

namespace ortung::server {

/// The way into the board: accepts connections, and keeps them until they have shown what they
/// speak. Until then they are no clients and take no client's place, and none of them keeps others
/// out: when there are too many, the oldest goes, of the computer that has the most.
/// All calls come from the thread of the io_context, but where a join comes from does not matter.
class Entrance final : public Porter {
 public:
  struct Ways {
    /// A connection that is to be a client's, and what it has said.
    std::function<void(Newcomer newcomer, std::string_view bytes)> enter;
    /// One that has said nothing for as long as it may.
    std::function<void(Newcomer newcomer)> dismiss;
  };

  /// @param io, config borrowed
  Entrance(boost::asio::io_context& io, const BoardConfig& config, Ways ways);
  ~Entrance() override;
  Entrance(const Entrance&) = delete;
  Entrance& operator=(const Entrance&) = delete;

  /// @returns the port @throws std::runtime_error if it can't listen there
  std::uint16_t listen();
  /// Ends those that take too long. @param now on the computer's clock
  void look(Timestamp now);
  /// Nobody comes in any more. Whoever has let the io_context run calls it before the end.
  void close();

  // Porter
  void enter(Newcomer newcomer, std::string_view bytes) override;
  void dismiss(Newcomer newcomer) override;
  std::function<int()> joinFor(const std::string& peer) override;
  void leave(ClientId id) override;

 private:
  struct Gate;
  void accept();
  void admit(boost::asio::ip::tcp::socket socket);
  void makeRoom(const std::string& peer);
  int join(const std::string& peer);
  void complain(const std::string& what);

  boost::asio::io_context& io_;
  const BoardConfig& config_;
  const Ways ways_;
  const std::shared_ptr<Gate> gate_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer retry_;
  std::map<ClientId, std::shared_ptr<Arrival>> arrivals_;  ///< the oldest first
  ClientId last_ = 0;
  Timestamp complained_ = 0;
  bool isClosed_ = false;
};

}  // namespace ortung::server

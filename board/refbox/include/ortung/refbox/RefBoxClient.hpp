#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/refbox/WorldState.hpp"

namespace ortung::refbox {

/// Where the box is, how the teams are called, and the limits of the connection.
struct ORTUNG_API RefBoxConfig {
  std::string host = "127.0.0.1";  ///< name or address of the box's computer
  std::uint16_t port = 28097;
  std::string ownTeam = "blue";  ///< the own team's name at the referee
  std::string otherTeam = "yellow";
  /// How the box calls the own team; "": as its WELCOME says.
  std::string address;
  double reportPeriod = 0.1;             ///< period of worldstates [s], at least 0.01
  double retry = 1.0;                    ///< pause between two attempts to connect [s]
  double connectTimeout = 5.0;           ///< [s]
  std::size_t longestMessage = 1 << 16;  ///< greatest length of the box's messages [bytes]
  void check() const;                    ///< @throws std::invalid_argument naming the field
};

/// Connects a referee and a team to a RefBox of the Middle Size League: hands on what the box
/// commands as orders, and reports the team's state to the box. It connects again whenever the
/// connection was lost. A message of the box that makes no sense is reported and ignored.
///
/// It has no thread of its own: all happens in poll(), on its caller's thread. Not thread-safe.
class ORTUNG_API RefBoxClient {
 public:
  /// @param state gives the team's state; called once a period while there is a connection
  /// @param order gets the orders, one at a time; an std::invalid_argument of it is reported
  /// @param tell gets what a person should know, a line each: connected, lost, nonsense
  /// @throws std::invalid_argument
  RefBoxClient(const RefBoxConfig& config, std::function<WorldState()> state,
               std::function<void(const std::string&)> order,
               std::function<void(const std::string&)> tell);
  ~RefBoxClient();
  RefBoxClient(const RefBoxClient&) = delete;
  RefBoxClient& operator=(const RefBoxClient&) = delete;

  /// Does what is to be done, without waiting; once a cycle, say.
  /// @param now time of a clock that only goes forwards [s]
  void poll(double now);

  /// Whether the connection to the box stands.
  bool isConnected() const;
  /// How the box calls the own team; "" as long as that is not known.
  const std::string& address() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung::refbox

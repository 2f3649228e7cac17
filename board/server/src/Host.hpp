#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "Command.hpp"
#include "Doorkeeper.hpp"
#include "Output.hpp"
#include "SlowTask.hpp"
#include "TalkBudget.hpp"
#include "WorldKeeper.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace ortung::server {

/// Where the server's words to one client go.
class Outlet {
 public:
  virtual ~Outlet();
  virtual void send(std::string_view text) = 0;
  /// The same, but more will come: waits for the next send() or flush().
  virtual void append(std::string_view text) = 0;
  /// The same; by default as text.
  virtual void add(Output&& output);
  virtual void flush() = 0;
  /// Bytes sent that the client has not read yet.
  virtual std::size_t outstanding() const = 0;
  /// Those of them that are words of large readings, which others share.
  virtual std::size_t outstandingReadings() const { return 0; }
  /// Ends the connection once everything is sent.
  virtual void finish() = 0;
  /// There is room for input again.
  virtual void resume() = 0;
  /// The client's computer, see addressKey().
  virtual const std::string& peer() const = 0;
};

class Conversation;

/// What all conversations share. Lives as long as they do.
class Host {
 public:
  Host(ServedWorld& world, const BoardConfig& boardConfig, WorldKeeper& worldKeeper);
  virtual ~Host();

  /// Has @p task run on the thread of the conversations; thread-safe.
  virtual void post(std::function<void()> task) = 0;
  /// Has @p task run where nobody waits for it but who asked; thread-safe.
  virtual void work(std::function<void()> task) = 0;
  /// The same for what takes so long that others should not wait behind it; by default they do.
  /// A client's newer task takes the place of one that was not begun. Thread-safe.
  virtual void workLong(ClientId client, SlowTask task);
  /// For what workLong() has run, while it holds no lock: it may be held up here. Thread-safe.
  virtual void paceLong() {}
  /// @p client has more lines than it gets done in a turn: calls its nextTurn() when those before
  /// it have had theirs. Such turns take a part of the time only, however many there are.
  virtual void queue(std::weak_ptr<Conversation> client) = 0;
  /// Tells all other clients at once.
  virtual void broadcast(ClientId from, std::string_view text) = 0;
  /// Tells all other clients what one of them says, when they have nothing better to hear.
  virtual void spread(ClientId from, std::string_view text) = 0;
  /// @p client has read all that was sent: it may hear what others have said.
  virtual void listen(Conversation& client) = 0;
  /// How many other clients would hear it.
  virtual std::size_t listeners(ClientId from) const = 0;
  /// A client's connection is closed; its conversation is not needed any more.
  virtual void forget(ClientId client) = 0;
  /// Somebody has begun or ended to subscribe.
  virtual void countSubscribers(int change) = 0;

  const BoardConfig config;
  const CommandTable commands;
  const WorldDescription description;
  const std::vector<std::string> plugins;
  const std::vector<std::string> players;     ///< lines of DESCRIBE players
  const std::vector<std::string> robotKinds;  ///< lines of DESCRIBE robots
  const RobotId liveRobot;                    ///< the robot of a live world; 0: it is not live
  WorldKeeper& keeper;
  Doorkeeper door;
  TalkBudget talk;  ///< budget that all clients share
};

}  // namespace ortung::server

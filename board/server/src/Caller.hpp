#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "ClientRobots.hpp"
#include "Command.hpp"
#include "Host.hpp"
#include "Question.hpp"
#include "Subscriptions.hpp"
#include "TalkBudget.hpp"
#include "WorldKeeper.hpp"

namespace ortung::server {

/// What an order replies; nothing: it does so later.
using Reply = std::optional<std::string>;

/// Who a client is, and what it has on the board.
struct ClientState {
  const ClientId id;
  TalkBudget talk;
  std::string name = {};
  Role role = Role::kViewer;
  bool hasJoined = false;
  ClientRobots robots = {};
  Subscriptions subscriptions = {};
};

/// The client that says a command, as the command sees it: who it is, how it is answered, and how
/// what takes its time is done. Replies leave in the order of requests, whoever makes them. All
/// calls come from the thread that talks to clients.
class Caller {
 public:
  /// Says what has become of an order. @param text as the order replied it
  using Then = std::function<void(Caller& caller, const std::string& tag, std::string text)>;

  virtual ~Caller();

  virtual Host& host() = 0;
  virtual ClientState& client() = 0;
  virtual const Outlet& outlet() const = 0;
  /// When its present input came, on the computer's clock.
  virtual Timestamp received() const = 0;
  /// Says whether anybody still waits for its answers; thread-safe, also when the client is gone.
  virtual std::function<bool()> isAwaited() const = 0;

  /// Answers at once; for what an order, answer() and aside() call. Behind the line comes @p body.
  virtual void reply(const std::string& tag, std::string_view text, std::string_view body = {}) = 0;
  virtual void reply(const std::string& tag, std::string_view text, Output&& body) = 0;
  /// The same for "ERR code text".
  virtual void error(const std::string& tag, std::string_view text) = 0;
  /// Tells it something that it did not ask for.
  virtual void tell(std::string_view text) = 0;
  /// Ends the connection with a last word, "ERR code text" or "BYE".
  virtual void dismiss(std::string_view text) = 0;
  /// Ends the connection once everything is sent.
  virtual void leave() = 0;

  /// Has the world's thread execute @p run, and then @p then here; by default that sends the reply.
  /// @param holdsLines whether the lines behind it depend on what becomes of it
  /// @param question see aside(); the lines behind it are held then
  virtual void order(const std::string& tag, WorldKeeper::Order run, Then then = {},
                     bool holdsLines = false, std::shared_ptr<Question> question = nullptr) = 0;
  /// Has @p say say something that needs no order, but not before what was asked for earlier.
  virtual void answer(const std::string& tag, std::function<void(Caller&)> say) = 0;
  /// Has @p work done on a thread beside, and then @p then here; lines behind it wait for that.
  /// What @p work throws is the reply. @param isLong whether others should not wait behind it
  /// @param question if the next line is the same command, this one is withdrawn for it, unless it
  ///   was begun, and answered "ERR superseded"; null: it is not
  virtual void aside(const std::string& tag, std::function<void()> work,
                     std::function<void(Caller&)> then, bool isLong,
                     std::shared_ptr<Question> question = nullptr) = 0;
  /// Calls @p then at @p due on the computer's clock; lines behind it wait for that.
  virtual void holdUntil(const std::string& tag, Timestamp due,
                         std::function<void(Caller&)> then) = 0;
  /// Calls @p then with the text that follows the line of the command, once it is there.
  /// @pre the command is one that has a text
  virtual void awaitText(const std::string& tag,
                         std::function<void(Caller&, std::string text)> then) = 0;
};

/// Orders what is replied with lines (or bytes) behind it: @p run puts them into its body, and
/// returns the line before them.
void orderBody(Caller& caller, const std::string& tag,
               std::function<std::string(WorldKeeper& keeper, std::string& body)> run);

}  // namespace ortung::server

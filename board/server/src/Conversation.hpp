#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Host.hpp"
#include "Request.hpp"
#include "RobotReadings.hpp"
#include "WorldKeeper.hpp"

namespace ortung::server {

/// What the server and one client say to each other: the protocol of docs/protocol.md, whatever
/// carries the bytes. All calls come from one thread.
class Conversation : public std::enable_shared_from_this<Conversation> {
 public:
  Conversation(Host& host, ClientId id, std::unique_ptr<Outlet> outlet);
  ~Conversation();

  /// Takes bytes from the client.
  void receive(std::string_view bytes);
  /// Whether more bytes should be read. Some always are, so that the end of a client is noticed.
  bool wantsInput() const { return !isOver_ && input_.size() - taken_ <= host_.config.limits.line; }
  /// It may take more of the lines that wait, see Host::queue().
  void nextTurn();
  /// A cycle has ended: sends what is subscribed.
  void onCycle();
  /// Does what is due. @param now on the computer's clock
  void look(Timestamp now);
  /// Something the server says to all.
  void tell(std::string_view text);
  /// Something another client says: told by hearOn(), lost if too much waits already.
  void hear(std::string_view text);
  /// Sends a piece of what others have said, if nothing else is on its way.
  /// @returns whether there is more that could be sent
  bool hearOn();
  /// Ends it with a last word, "ERR code text" or "BYE".
  void dismiss(std::string_view text);
  /// The connection is gone: the client's robots leave the field.
  void hangUp();

  bool isOver() const { return isOver_; }
  bool hasJoined() const { return hasJoined_; }
  /// Whether others have said something that it was not told yet.
  bool hasTalk() const { return !heard_.empty() || unheard_ > 0; }
  bool isSubscribed() const { return !subscriptions_.empty(); }
  bool isWaiting() const { return waiting_ > 0 || pending_ > 0; }
  /// Whether it asked for something that is not answered yet.
  bool hasOpenRequests() const {
    return !isOver_ && (isWaiting() || input_.find('\n', taken_) != std::string::npos);
  }
  ClientId id() const { return id_; }
  /// Whether the protocol has this command.
  static bool knows(std::string_view command);

 private:
  enum class Role { kViewer, kPlayer, kOperator };
  struct Command {
    const char* name;
    Role role;  ///< the least that may use it
    void (Conversation::*handle)(Request&);
    const char* help;
  };
  static const std::vector<Command>& commands();
  static const char* toText(Role role);
  static Role parseRole(const std::string& text);

  /// A robot as this client sees it.
  struct View {
    std::shared_ptr<RobotReadings> readings;
    std::vector<std::uint64_t> sent;
  };
  struct Subscription {
    Choice choice;
    Timestamp period = 0;
    Timestamp due = 0;
    std::int64_t ahead = 0;   ///< updates that may be on their way; 0: any number
    std::int64_t unread = 0;  ///< that the client has not said GOT to
    bool isOwed = false;      ///< something newer waits for that
  };
  struct Greeting {  ///< HELLO
    std::string tag;
    std::string name;
    std::string token;
    std::optional<Role> role;  ///< that it asks for
    Timestamp due = 0;         ///< when it is looked at, or its refusal told
    bool isRefused = false;
  };
  struct Configuration {  ///< on its way
    std::string tag;
    RobotWish wish;
    std::string text;
    std::string fault;
  };
  using Then = std::function<void(Conversation&, const std::string& tag, std::string text)>;

  // lines and replies (Conversation.cpp)
  /// Not while the client's orders wait for the world: so replies come in the order of requests.
  bool mayTakeLine() const {
    return !isOver_ && waiting_ == 0 && pending_ < host_.config.limits.orders;
  }
  bool takeLine();
  void takeLines();
  bool takeTurn();
  void put(std::string_view text);
  void flushSoon();
  void goOn();
  void handleLine(std::string_view line);
  void handleConfigurationLine(std::string_view line);
  void dispatch(Request& request);
  void checkRole(const std::string& command, Role least) const;
  void reply(const std::string& tag, std::string_view text, std::string_view body = {});
  void reply(const std::string& tag, std::string_view text, Output&& body);
  bool mayReply();
  void error(const std::string& tag, std::string_view text);
  void refuse(const std::string& tag, const std::string& text);
  void order(const std::string& tag, WorldKeeper::Order run, Then then = {},
             bool holdsLines = false);
  void answer(const std::string& tag, std::function<void(Conversation&)> say);

  // commands of whoever hosts the board (ConversationAdded.cpp)
  const BoardCommand* findAdded(const std::string& name) const;
  void callAdded(const BoardCommand& command, Request& request);
  void callSlow(const BoardCommand& command, const std::string& tag, BoardCommand::Call call);

  // ConversationRobots.cpp
  void create(Request& request);
  void finishConfiguration();
  static void readConfiguration(Configuration& configuration, const Host& host);
  void createRobot(const std::string& tag, RobotWish wanted);
  void remove(Request& request);
  void velocity(Request& request);
  void motion(Request& request);
  void manipulator(Request& request);
  void update(Request& request);
  void read(Request& request);
  void subscribe(Request& request);
  void unsubscribe(Request& request);
  void got(Request& request);
  void endSubscription(RobotId robot);
  void endSubscriptions();
  bool sendSubscribed(RobotId robot, Subscription& subscription);
  void lockstep(Request& request);
  void next(Request& request);
  /// @param orWorld whether robot 0, the world itself, will do, too
  RobotId takeRobot(Request& request, bool orWorld = false) const;
  void checkMayWatch(RobotId robot) const;
  Choice takeChoice(Request& request, bool again) const;
  void fetch(Request& request, bool again);
  void sendReadings(const std::string& tag, const char* command, RobotId robot,
                    const Choice& choice);
  void foreignReadings(const std::string& tag, const char* command, RobotId robot,
                       const Choice& choice);

  // ConversationTalk.cpp
  void hello(Request& request);
  void checkToken(const Greeting& greeting);
  void join(const Greeting& greeting);
  void bye(Request& request);
  void help(Request& request);
  void time(Request& request);
  void status(Request& request);
  void list(Request& request);
  void describe(Request& request);
  void describeWorld(const std::string& tag);
  void describeField(const std::string& tag);
  void describeKinds(const std::string& tag, const std::vector<std::string>& kinds);
  void say(Request& request);
  void tellTeam(Request& request);
  void hearTeam(Request& request);
  void score(Request& request);

  // ConversationControl.cpp
  void pause(Request& request);
  void resume(Request& request);
  void step(Request& request);
  void speed(Request& request);
  void reset(Request& request);
  void seek(Request& request);
  void place(Request& request);

  Host& host_;
  const ClientId id_;
  std::unique_ptr<Outlet> outlet_;
  std::string input_;
  std::size_t taken_ = 0;  ///< bytes of input_ that are done with
  std::size_t searched_ = 0;
  Timestamp received_ = 0;  ///< when the present input came, on the computer's clock
  std::string name_;
  Role role_ = Role::kViewer;
  bool hasJoined_ = false;
  bool isOver_ = false;
  /// The same for other threads: nobody waits for an answer any more.
  const std::shared_ptr<std::atomic<bool>> isGone_ = std::make_shared<std::atomic<bool>>(false);
  bool isReceiving_ = false;
  bool isTurnOver_ = false;     ///< others come first
  bool isFlushPosted_ = false;  ///< of the outlet
  TalkBudget talk_;
  std::string heard_;                 ///< of what others say, not told yet
  std::size_t unheard_ = 0;           ///< what others said while too much of that waited
  std::size_t pending_ = 0;           ///< orders that the world has not executed
  int waiting_ = 0;                   ///< requests that wait for cycles
  std::size_t errors_ = 0;            ///< in a row
  std::optional<Greeting> greeting_;  ///< that has to wait
  std::optional<Configuration> configuration_;
  std::map<RobotId, View> views_;
  std::set<RobotId> owned_;
  std::map<RobotId, Subscription> subscriptions_;
};

}  // namespace ortung::server

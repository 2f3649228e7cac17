#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Caller.hpp"

namespace ortung::server {

/// The connection of one client, whatever carries the bytes: takes lines, gives each to the command
/// that it names (docs/protocol.md), and sends what is replied. All calls come from one thread.
class Conversation final : public Caller, public std::enable_shared_from_this<Conversation> {
 public:
  Conversation(Host& host, ClientId id, std::unique_ptr<Outlet> outlet);
  ~Conversation() override;

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
  /// Something another client says: told by hearOn(), lost if too much waits already.
  void hear(std::string_view text);
  /// Sends a piece of what others have said, if nothing else is on its way.
  /// @returns whether there is more that could be sent
  bool hearOn();
  /// The connection is gone: the client's robots leave the field.
  void hangUp();

  bool isOver() const { return isOver_; }
  bool hasJoined() const { return client_.hasJoined; }
  /// Whether others have said something that it was not told yet.
  bool hasTalk() const { return !heard_.empty() || unheard_ > 0; }
  bool isSubscribed() const { return !client_.subscriptions.isEmpty(); }
  bool isWaiting() const { return waiting_ > 0 || pending_ > 0; }
  /// Whether it asked for something that is not answered yet.
  bool hasOpenRequests() const {
    return !isOver_ && (isWaiting() || input_.find('\n', taken_) != std::string::npos);
  }
  ClientId id() const { return client_.id; }

  // Caller
  Host& host() override { return host_; }
  ClientState& client() override { return client_; }
  const Outlet& outlet() const override { return *outlet_; }
  Timestamp received() const override { return received_; }
  std::function<bool()> isAwaited() const override;
  void reply(const std::string& tag, std::string_view text, std::string_view body) override;
  void reply(const std::string& tag, std::string_view text, Output&& body) override;
  void error(const std::string& tag, std::string_view text) override;
  void tell(std::string_view text) override;
  void dismiss(std::string_view text) override;
  void leave() override;
  void order(const std::string& tag, WorldKeeper::Order run, Then then, bool holdsLines,
             std::shared_ptr<Question> question) override;
  void answer(const std::string& tag, std::function<void(Caller&)> say) override;
  void aside(const std::string& tag, std::function<void()> work, std::function<void(Caller&)> then,
             bool isLong, std::shared_ptr<Question> question) override;
  void holdUntil(const std::string& tag, Timestamp due, std::function<void(Caller&)> then) override;
  void awaitText(const std::string& tag,
                 std::function<void(Caller&, std::string text)> then) override;

 private:
  struct Held {  ///< see holdUntil()
    std::string tag;
    Timestamp due = 0;
    std::function<void(Caller&)> then;
  };
  struct Asked {  ///< a question that waits for its turn, see Question
    std::shared_ptr<Question> question;
    const Command* command = nullptr;
    std::string tag;
    bool isOrder = false;
  };
  struct Text {  ///< a text whose line has not come yet, see awaitText()
    std::string tag;
    std::function<void(Caller&, std::string text)> then;
    std::string fault;  ///< error of the text, or of the line before it; "": none
    std::string text = {};
  };

  // lines (Conversation.cpp)
  /// Not while the client's orders wait for the world: so replies come in the order of requests.
  bool mayTakeLine() const {
    return !isOver_ && waiting_ == 0 && pending_ < host_.config.limits.orders;
  }
  bool takeLine();
  bool isReplaced();
  void note(std::shared_ptr<Question> question, const std::string& tag, bool isOrder);
  void takeLines();
  bool takeTurn();
  void goOn();
  void handleLine(std::string_view line);
  void handleTextLine(std::string_view line);
  void call(const Command* command, Request& request);

  // replies (ConversationReplies.cpp)
  void tellSuperseded();
  void put(std::string_view text);
  void flushSoon();
  bool mayReply();
  void refuse(const std::string& tag, const std::string& text);

  Host& host_;
  std::unique_ptr<Outlet> outlet_;
  ClientState client_;
  std::string input_;
  std::size_t taken_ = 0;  ///< bytes of input_ that are done with
  std::size_t searched_ = 0;
  Timestamp received_ = 0;  ///< arrival of the present input on the computer's clock [us]
  bool isOver_ = false;
  /// The same for other threads: nobody waits for an answer any more.
  const std::shared_ptr<std::atomic<bool>> isGone_ = std::make_shared<std::atomic<bool>>(false);
  bool isReceiving_ = false;
  bool isTurnOver_ = false;     ///< others come first
  bool isFlushPosted_ = false;  ///< whether a flush of the outlet has been posted
  std::string heard_;           ///< lines that others said, not sent yet
  std::size_t unheard_ = 0;     ///< what others said while too much of that waited
  std::size_t pending_ = 0;     ///< orders that the world has not executed
  int waiting_ = 0;             ///< requests that wait for cycles
  std::size_t errors_ = 0;      ///< errors in a row
  std::optional<Held> held_;
  std::optional<Text> text_;
  const Command* handled_ = nullptr;  ///< the command that is being called
  std::optional<Asked> asked_;
  std::vector<std::string> superseded_;  ///< tags of withdrawn questions that are not answered yet
  bool isNextKnown_ = false;             ///< whether the line behind asked_ was looked at
};

}  // namespace ortung::server

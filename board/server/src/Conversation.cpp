#include "Conversation.hpp"

#include <algorithm>
#include <utility>

#include "Request.hpp"

namespace ortung::server {
namespace {

// Limits of one client's turn, before the next client's begins.
constexpr int kLinesOfTurn = 32;
constexpr Timestamp kTimeOfTurn = 100;    // [us]
constexpr double kTalkOfNewcomers = 0.2;  // share of a second's talk: reconnecting gains none

}  // namespace

Conversation::Conversation(Host& host, ClientId id, std::unique_ptr<Outlet> outlet)
    : host_(host),
      outlet_(std::move(outlet)),
      client_{.id = id,
              .talk = TalkBudget(host.config.limits.talkLines, host.config.limits.talkBytes,
                                 kTalkOfNewcomers)} {}

Conversation::~Conversation() { *isGone_ = true; }

void Conversation::receive(std::string_view bytes) {
  received_ = wallTime();
  input_ += bytes;
  takeLines();
}

void Conversation::takeLines() {
  if (isReceiving_ || isTurnOver_) return;
  isReceiving_ = true;
  isTurnOver_ = takeTurn();
  isReceiving_ = false;
  outlet_->flush();
  if (isTurnOver_) host_.queue(weak_from_this());
  if (isOver_) {
    input_.clear();
    taken_ = searched_ = 0;
  } else if (taken_ == input_.size() || taken_ > (1u << 14)) {
    input_.erase(0, taken_);
    searched_ -= taken_;
    taken_ = 0;
  }
}

/// @returns whether the turn ended although more lines can be taken
bool Conversation::takeTurn() {
  const Timestamp begin = wallTime();
  for (int lines = 0; mayTakeLine() || isReplaced(); ++lines) {
    const bool isLate = lines > 0 && wallTime() - begin >= kTimeOfTurn;  // it always takes one
    if (lines == kLinesOfTurn || isLate) return true;
    if (!takeLine()) return false;
  }
  return false;
}

/// Withdraws a question that waits for its turn, if the next line asks anew: so who asks faster
/// than it is answered gets the newest answer, and has one question in the queue.
bool Conversation::isReplaced() {
  if (isOver_ || !asked_ || isNextKnown_ || waiting_ != 1 ||
      superseded_.size() >= host_.config.limits.orders)
    return false;
  const std::size_t end = input_.find('\n', searched_);
  if (end == input_.npos) {
    searched_ = input_.size();
    return false;
  }
  isNextKnown_ = true;
  if (end - taken_ > host_.config.limits.line) return false;
  const Request next(std::string_view(input_).substr(taken_, end - taken_));
  if (!next.fault().empty() || host_.commands.find(next.command()) != asked_->command ||
      !asked_->question->withdraw())
    return false;
  const Asked old = *std::exchange(asked_, std::nullopt);
  --waiting_;
  if (old.isOrder) --pending_;
  superseded_.push_back(old.tag);
  return mayTakeLine();
}

bool Conversation::takeLine() {
  const std::size_t end = input_.find('\n', searched_);
  const std::size_t length = std::min(end, input_.size()) - taken_;
  if (length > host_.config.limits.line) {
    dismiss("ERR line a line is longer than " + std::to_string(host_.config.limits.line) +
            " bytes");
    return false;
  }
  if (end == input_.npos) {
    searched_ = input_.size();
    return false;
  }
  std::string line = input_.substr(taken_, length);
  taken_ = searched_ = end + 1;
  isNextKnown_ = false;
  if (line.ends_with('\r')) line.pop_back();
  handleLine(line);
  return true;
}

void Conversation::handleLine(std::string_view line) {
  if (text_) {
    handleTextLine(line);
    return;
  }
  if (line.empty()) return;
  Request request(line);
  if (!request.fault().empty()) {
    refuse(request.tag(), "ERR syntax " + request.fault());
    return;
  }
  const Command* const command = host_.commands.find(request.command());
  try {
    call(command, request);
  } catch (...) {
    tellSuperseded();
    if (command != nullptr && command->hasText)  // its text is sent in any case
      text_ = Text{request.tag(), {}, currentErrorText()};
    else
      refuse(request.tag(), currentErrorText());
  }
}

void Conversation::call(const Command* command, Request& request) {
  if (command == nullptr)
    throw ServeError("unknown",
                     "there is no command " + printable(request.command()) + "; HELP lists them");
  if (command->least && !client_.hasJoined) throw ServeError("hello", "say HELLO ortung/1 first");
  if (command->least && client_.role < *command->least)
    throw ServeError("role", command->name + " needs the role " + nameOf(*command->least) +
                                 ", this client is a " + nameOf(client_.role));
  handled_ = command;
  command->handle(*this, request);
}

void Conversation::awaitText(const std::string& tag,
                             std::function<void(Caller&, std::string text)> then) {
  text_ = Text{tag, std::move(then), {}};
}

void Conversation::handleTextLine(std::string_view line) {
  if (line == ".") {
    Text text = *std::exchange(text_, std::nullopt);
    if (text.fault.empty())
      text.then(*this, std::move(text.text));
    else
      refuse(text.tag, text.fault);
    return;
  }
  if (line.starts_with('.')) line.remove_prefix(1);  // as in mail: a text's own dot is doubled
  std::string& text = text_->text;
  const std::size_t most = host_.config.limits.configuration;
  if (text.size() + line.size() + 1 > most) {
    if (text_->fault.empty())
      text_->fault = "ERR limit a robot file has at most " + std::to_string(most) + " bytes";
    text.clear();
    return;
  }
  text.append(line).append("\n");
}

void Conversation::onCycle() {
  if (!isOver_) client_.subscriptions.onCycle(*this);
}

/// Continues when there is room for more lines, which are taken in a turn, however many orders were
/// executed.
void Conversation::goOn() {
  const bool hasLine = input_.find('\n', searched_) != std::string::npos;
  if (hasLine && !isReceiving_ && !std::exchange(isTurnOver_, true)) host_.queue(weak_from_this());
  if (!hasLine && wantsInput()) outlet_->resume();
}

void Conversation::nextTurn() {
  isTurnOver_ = false;
  takeLines();
  if (wantsInput()) outlet_->resume();
}

}  // namespace ortung::server

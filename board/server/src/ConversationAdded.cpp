// Commands of whoever hosts the board.
#include <algorithm>

#include "Conversation.hpp"

namespace ortung::server {
namespace {

constexpr std::size_t kLongestReply = 4096;  // line

/// What a command has answered, as it goes to the client.
struct Answer {
  std::string text;  ///< "OK NAME ..." or "ERR code text"
  std::string body;
};

Answer execute(const BoardCommand& command, const BoardCommand::Call& call) {
  BoardCommand::Reply reply = command.handle(call);
  Answer answer{"OK " + command.name, std::move(reply.bytes)};
  if (!reply.words.empty()) answer.text += " " + printable(reply.words, kLongestReply);
  if (!answer.body.empty()) {
    answer.text += " bytes=" + std::to_string(answer.body.size());
    return answer;
  }
  if (!reply.lines.empty()) answer.text += " lines=" + std::to_string(reply.lines.size());
  for (const std::string& line : reply.lines) answer.body += printable(line, kLongestReply) + '\n';
  return answer;
}

}  // namespace

const BoardCommand* Conversation::findAdded(const std::string& name) const {
  const auto& added = host_.config.commands;
  const auto found = std::find_if(added.begin(), added.end(), [&](const BoardCommand& command) {
    return command.name == name;
  });
  return found == added.end() ? nullptr : &*found;
}

void Conversation::callAdded(const BoardCommand& command, Request& request) {
  if (command.needsControl) checkRole(command.name, Role::kOperator);
  BoardCommand::Call call{name_, request.takeWords(), request.takeKeys(),
                          static_cast<BoardCommand::Role>(role_),
                          [isGone = isGone_] { return !*isGone; }};
  if (command.isSlow) {
    callSlow(command, request.tag(), std::move(call));
    return;
  }
  auto body = std::make_shared<std::string>();
  order(
      request.tag(),
      [&command, call = std::move(call), body](WorldKeeper&, WorldKeeper::Done&) {
        Answer answer = execute(command, call);
        *body = std::move(answer.body);
        return std::optional<std::string>(std::move(answer.text));
      },
      [body](Conversation& self, const std::string& tag, const std::string& text) {
        self.reply(tag, text, *body);
      });
}

/// Elsewhere; the client's next lines wait, so its replies stay in order.
void Conversation::callSlow(const BoardCommand& command, const std::string& tag,
                            BoardCommand::Call call) {
  ++waiting_;
  host_.workLong([weak = weak_from_this(), host = &host_, &command, tag, call = std::move(call)] {
    if (!call.isAwaited()) return;
    auto answered = std::make_shared<Answer>();
    try {
      *answered = execute(command, call);
    } catch (...) {
      answered->text = currentErrorText();
    }
    host->post([weak, tag, answered] {
      const auto self = weak.lock();
      if (!self) return;
      --self->waiting_;
      if (self->isOver_) return;
      self->answer(tag, [tag, answered](Conversation& me) {
        if (answered->text.starts_with("ERR "))
          me.error(tag, answered->text);
        else
          me.reply(tag, answered->text, answered->body);
      });
      self->goOn();
    });
  });
}

}  // namespace ortung::server

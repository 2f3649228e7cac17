// Commands that the board's host adds.
#include "Caller.hpp"
#include "Request.hpp"
#include "Rooms.hpp"

namespace ortung::server {
namespace {

constexpr std::size_t kLongestReply = 4096;  // longest line of a reply [bytes]

/// A command's reply, as it is sent to the client.
struct Answer {
  std::string text;  ///< "OK NAME ..."
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

/// Calls a slow command on another thread; the client's next lines wait, so its replies stay in
/// order.
void callSlow(Caller& caller, const std::string& tag,
              const std::shared_ptr<const BoardCommand>& command, BoardCommand::Call call) {
  auto answered = std::make_shared<Answer>();
  caller.aside(
      tag, [command, call = std::move(call), answered] { *answered = execute(*command, call); },
      [tag, answered](Caller& its) {
        its.answer(tag, [tag, answered](Caller& self) {
          self.reply(tag, answered->text, answered->body);
        });
      },
      true, command->isReplaceable ? std::make_shared<Question>() : nullptr);
}

void call(Caller& caller, Request& request, const std::shared_ptr<const BoardCommand>& command) {
  const ClientState& client = caller.client();
  BoardCommand::Call said{client.name, request.takeWords(), request.takeKeys(), client.role,
                          caller.isAwaited()};
  if (command->isSlow) {
    callSlow(caller, request.tag(), command, std::move(said));
    return;
  }
  orderBody(caller, request.tag(),
            [command, said = std::move(said)](WorldKeeper&, std::string& body) {
              Answer answer = execute(*command, said);
              body = std::move(answer.body);
              return std::move(answer.text);
            });
}

}  // namespace

std::vector<Command> addedCommands(const std::vector<BoardCommand>& commands) {
  std::vector<Command> all;
  for (const BoardCommand& one : commands) {
    const auto command = std::make_shared<const BoardCommand>(one);
    all.push_back({one.name, one.least, one.help, [command](Caller& caller, Request& request) {
                     call(caller, request, command);
                   }});
  }
  return all;
}

}  // namespace ortung::server

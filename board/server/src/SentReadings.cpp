#include "SentReadings.hpp"

#include "Caller.hpp"

namespace ortung::server {

void sendReadings(Caller& caller, const std::string& tag, const char* command, RobotId robot,
                  const Choice& choice) {
  ClientRobots::View* const view = caller.client().robots.view(robot);
  if (view == nullptr) {
    caller.error(tag,
                 "ERR no-robot there is no robot " + std::to_string(robot) + " of this client");
    return;
  }
  Output body;
  const Written written = view->readings->write(choice, view->sent, body);
  std::string head = tag == "*" ? "" : "OK ";  // an update is no reply
  head.append(command).append(" robot=").append(std::to_string(robot));
  head.append(" now=").append(std::to_string(caller.host().keeper.clock().at(wallTime())));
  if (choice.binary) head.append(" bytes=").append(std::to_string(body.size()));
  head.append(choice.binary ? " readings=" : " lines=").append(std::to_string(written.readings));
  if (written.leftOut > 0) head.append(" left_out=").append(std::to_string(written.leftOut));
  if (body.readingBytes() > 0)
    caller.reply(tag, head, std::move(body));
  else
    caller.reply(tag, head, body.isEmpty() ? "" : body.text());
}

}  // namespace ortung::server

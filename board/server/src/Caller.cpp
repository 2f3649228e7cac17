#include "Caller.hpp"

namespace ortung::server {

Caller::~Caller() = default;

void orderBody(Caller& caller, const std::string& tag,
               std::function<std::string(WorldKeeper& keeper, std::string& body)> run) {
  auto body = std::make_shared<std::string>();
  caller.order(
      tag,
      [run = std::move(run), body](WorldKeeper& keeper, WorldKeeper::Done&) {
        return Reply(run(keeper, *body));
      },
      [body](Caller& its, const std::string& itsTag, const std::string& text) {
        its.reply(itsTag, text, *body);
      });
}

}  // namespace ortung::server

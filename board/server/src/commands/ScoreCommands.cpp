// The command SCORE, for a score that is kept by hand.
#include "Caller.hpp"
#include "Request.hpp"
#include "Rooms.hpp"

namespace ortung::server {
namespace {

constexpr std::int64_t kMostGoals = 999;

void score(Caller& caller, Request& request) {
  const auto left = request.takeInteger("left", 0, kMostGoals);
  const auto right = request.takeInteger("right", 0, kMostGoals);
  request.refuseRest();
  if ((left || right) && caller.client().role != Role::kOperator)
    throw ServeError("role", "setting the SCORE needs the role operator");
  caller.order(request.tag(), [left, right](WorldKeeper& keeper, WorldKeeper::Done&) {
    if (left) keeper.score.left = static_cast<int>(*left);
    if (right) keeper.score.right = static_cast<int>(*right);
    return Reply("OK SCORE left=" + std::to_string(keeper.score.left) +
                 " right=" + std::to_string(keeper.score.right));
  });
}

}  // namespace

std::vector<Command> scoreCommands() {
  return {{"SCORE", Role::kViewer, "[left=N right=N], which is for operators", score}};
}

}  // namespace ortung::server

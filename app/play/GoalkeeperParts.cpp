#include "GoalkeeperParts.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

namespace ortung::app {
namespace {

constexpr const char* kMatrix = "matrix";

}  // namespace

void write(const GoalMatrix& shard, PartHead head, const std::filesystem::path& file) {
  PartWriter part(file, std::move(head));
  addLongText(part.content(), kMatrix, toJson(shard, ORTUNG_VERSION));
  part.commit();
}

GoalMatrix mergeMatrices(const PartSet& parts) {
  std::vector<GoalMatrix> shards;
  try {
    for (std::size_t i = 0; i < parts.size(); ++i)
      shards.push_back(
          readGoalMatrix(parts.textOf(i, kMatrix), "part " + toText({i + 1, parts.size()})));
    return mergeShards(shards);
  } catch (const std::invalid_argument& error) {
    throw PartError({error.what()});
  }
}

}  // namespace ortung::app

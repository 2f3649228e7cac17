#include <stdexcept>
#include <vector>

#include "Football.hpp"

namespace ortung::app {

FootballMatrix mergeFootballParts(const PartSet& parts) {
  std::vector<FootballMatrix> shards;
  try {
    for (std::size_t i = 0; i < parts.size(); ++i)
      shards.push_back(
          readFootball(parts.textOf(i, kFootballParts), "part " + toText({i + 1, parts.size()})));
    return mergeFootball(shards);
  } catch (const std::invalid_argument& error) {
    throw PartError({error.what()});
  }
}

}  // namespace ortung::app

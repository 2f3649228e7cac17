#include "ortung/server/PlainWorld.hpp"

namespace ortung {

PlainWorld::~PlainWorld() = default;

void PlainWorld::seek(Timestamp) {
  throw ServeError("state", "this world has no time line: SEEK is for a record that is viewed");
}

}  // namespace ortung

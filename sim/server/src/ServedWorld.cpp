#include "ortung/server/ServedWorld.hpp"

namespace ortung {

ServeError::~ServeError() = default;
ServedWorld::~ServedWorld() = default;

}  // namespace ortung

#include "ortung/server/ForwardedWorld.hpp"

namespace ortung {

ForwardedWorld::~ForwardedWorld() = default;

}  // namespace ortung

#include "ortung/server/ForwardedWorld.hpp"

#include <type_traits>

namespace ortung {

static_assert(!std::is_abstract_v<ForwardedWorld>,
              "a question to a ServedWorld is not passed on by ForwardedWorld");

ForwardedWorld::~ForwardedWorld() = default;

}  // namespace ortung

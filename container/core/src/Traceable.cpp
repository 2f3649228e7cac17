#include "ortung/core/Traceable.hpp"

namespace ortung {

Traceable::~Traceable() = default;

}  // namespace ortung

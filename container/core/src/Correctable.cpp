#include "ortung/core/Correctable.hpp"

namespace ortung {

Correctable::~Correctable() = default;

}  // namespace ortung

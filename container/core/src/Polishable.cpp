#include "ortung/core/Polishable.hpp"

namespace ortung {

Polishable::~Polishable() = default;

}  // namespace ortung

#include "ortung/core/BlurrableWeigher.hpp"

namespace ortung {

BlurrableWeigher::~BlurrableWeigher() = default;

}  // namespace ortung

#include "CommandModule.hpp"
#include "ortung/container/Abi.hpp"

namespace ortung::app {

const char* commandVersion() { return ORTUNG_CONTAINER_ABI; }

}  // namespace ortung::app

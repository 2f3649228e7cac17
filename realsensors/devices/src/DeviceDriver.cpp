#include "ortung/devices/DeviceDriver.hpp"

namespace ortung {

DeviceMisfit::~DeviceMisfit() = default;
DeviceDriver::~DeviceDriver() = default;

}  // namespace ortung

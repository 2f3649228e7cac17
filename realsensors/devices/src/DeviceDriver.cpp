#include "ortung/devices/DeviceDriver.hpp"

namespace ortung {

DeviceMisfit::~DeviceMisfit() = default;
DeviceDriver::~DeviceDriver() = default;

void DeviceDriver::refresh() {}

}  // namespace ortung

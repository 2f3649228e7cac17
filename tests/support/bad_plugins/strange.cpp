#include <stdexcept>

#include "ortung/core/Plugin.hpp"

/// Plugins whose constructors fail in every way that C++ offers.
namespace ortung {
namespace {

DeviceData throwsRuntimeError(const Parameters&) {
  throw std::runtime_error("no light in the lamp");
}
DeviceData throwsLogicError(const Parameters&) { throw std::logic_error("vector::_M_range_check"); }
DeviceData throwsInvalidArgument(const Parameters&) {
  throw std::invalid_argument("beams without a step");
}
DeviceData throwsConfigError(const Parameters& p) {
  p.number("max_range_m", {0.1, 10});
  return {};
}
DeviceData throwsANumber(const Parameters&) { throw 7; }
DeviceData makesNothing(const Parameters&) { return {}; }

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("strange", ortung::provideData<ortung::throwsRuntimeError>("throws_runtime"),
               ortung::provideData<ortung::throwsLogicError>("throws_logic"),
               ortung::provideData<ortung::throwsInvalidArgument>("throws_argument"),
               ortung::provideData<ortung::throwsConfigError>("throws_config"),
               ortung::provideData<ortung::throwsANumber>("throws_number"),
               ortung::provideData<ortung::makesNothing>("makes_nothing"));

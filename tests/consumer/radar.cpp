// A plugin of somebody else: a sensor with a class of its own.
#include "../support/Radar.hpp"

#include "ortung/core/Plugin.hpp"

namespace {

ortung::DeviceData makeRadar(const ortung::Parameters&) {
  ortung::DeviceData data;
  data.push_back(
      std::make_unique<ortung::test::RadarData>(ortung::SensorId{"acme", "radar", "echoes"}));
  return data;
}

}  // namespace

ORTUNG_PLUGINS("radar", ortung::provideData<makeRadar>("radar"));

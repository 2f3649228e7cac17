#include "ortung/formats/OdometryData.hpp"

#include "OdometrySettings.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

DeviceData makeOdometry(const Parameters& p) {
  DeviceData data;
  data.push_back(std::make_unique<OdometryData>(readOdometrySettings(p).id));
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("odometry_data", ortung::provideData<ortung::makeOdometry>("odometry"));

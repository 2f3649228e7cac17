#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace {

ortung::DeviceData makeDistance(const ortung::Parameters&) { return {}; }

/// What no version of the board knows.
struct Oracle {
  static constexpr const char* kInterface = "ortung.Oracle/1";
  explicit Oracle(const ortung::Parameters&) {}
};

}  // namespace

ORTUNG_PLUGINS("stranger", ortung::provideData<makeDistance>("yardstick"),
               ortung::provide<Oracle, Oracle>("oracle"));

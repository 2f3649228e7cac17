#include "MrptScanner.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

/// A Hokuyo scanner that speaks SCIP 2.0, at a serial line (USB) or a socket.
class HokuyoDevice : public MrptScanner {
 public:
  explicit HokuyoDevice(const Parameters& p)
      : MrptScanner(p.text("port"), {"hokuyo", p.text("port")}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("hokuyo_device",
               ortung::provide<ortung::DeviceDriver, ortung::HokuyoDevice>("hokuyo"));

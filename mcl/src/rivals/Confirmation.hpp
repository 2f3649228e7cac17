#pragma once

#include "ortung/base/Export.hpp"

namespace ortung {

/// Whether a place that one time step's readings have chosen out of the whole field has been
/// confirmed since: by several readings that fit there as well as usual, over some distance
/// travelled. A place that fits only at random, or because the map is incomplete, does not keep
/// fitting. Not thread-safe.
class ORTUNG_API Confirmation {
 public:
  /// Begins to confirm a place that was chosen.
  void begin() {
    isOpen_ = true;
    travelled_ = 0.0;
    readings_ = 0;
  }
  void forget() { isOpen_ = false; }
  /// Counts one time step's readings.
  /// @param isUsual whether they fit as well as usual
  /// @param travelled distance travelled since the readings before [m]; turns do not count, since a
  ///   robot that turns on the spot sees the same surroundings
  void count(bool isUsual, double travelled);
  bool isOpen() const { return isOpen_; }

 private:
  bool isOpen_ = false;
  double travelled_ = 0.0;
  int readings_ = 0;
};

}  // namespace ortung

#pragma once

#include "ortung/base/Export.hpp"

namespace ortung {

/// Whether a place that one moment's readings have chosen out of the whole field has been confirmed
/// since: by some readings on some way that fit there as they use to. What fits once by chance, or
/// since the map lacks something, does not go on to fit. Not thread-safe.
class ORTUNG_API Confirmation {
 public:
  /// A place was chosen.
  void begin() {
    isOpen_ = true;
    way_ = 0.0;
    readings_ = 0;
  }
  void forget() { isOpen_ = false; }
  /// @param way since the readings before [m]; a turn on the spot shows the same surroundings
  void count(bool isUsual, double way);
  bool isOpen() const { return isOpen_; }

 private:
  bool isOpen_ = false;
  double way_ = 0.0;
  int readings_ = 0;
};

}  // namespace ortung

#pragma once

#include <optional>
#include <utility>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// Notices when odometry stays away: a cable, a driver or a radio link failed. The robot may go on
/// meanwhile, and nothing says where. Not thread-safe.
class ORTUNG_API OdometrySilence {
 public:
  /// Takes the stamp of the newest odometry; nothing: there is none.
  void hear(const std::optional<Timestamp>& newest);
  void forget() { *this = {}; }
  /// Returns since when there has been no odometry that would have to be there at @p stamp: the
  /// stamp of the newest one. Nothing: it is no older than usual, or there never was any.
  std::optional<Timestamp> since(Timestamp stamp) const;

  /// Returns whether odometry was silent at @p stamp, but for so short a time that what it says
  /// before and after tells how the robot moved meanwhile.
  bool isBridged(Timestamp stamp) const;

 private:
  double patience() const;  ///< greatest age that is no silence [s]

  std::optional<Timestamp> newest_;
  std::optional<std::pair<Timestamp, Timestamp>> ended_;  ///< begin and end of the last silence
  double usual_ = 0.0;  ///< longest time between two of them lately [s]
};

}  // namespace ortung

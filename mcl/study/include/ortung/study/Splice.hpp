#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/study/Recording.hpp"

namespace ortung {

/// A piece of a recording: its messages [begin, end). Messages with equal stamps stay together.
struct Piece {
  std::size_t begin = 0;  ///< index of the first message
  std::size_t end = 0;    ///< index after the last message
};

/// Pieces of one recording, joined: time and odometry go on without a jump, as if the robot was
/// carried from the end of one piece to the beginning of the next. It is immutable, so any number
/// of threads may use it.
class ORTUNG_API Splice {
 public:
  /// @throws std::invalid_argument if there is no piece, or one is empty or outside of the
  /// recording
  Splice(std::shared_ptr<const Recording> recording, std::vector<Piece> pieces);
  ~Splice();

  /// Returns the first stamps of all pieces but the first one, at which the robot is suddenly
  /// elsewhere [us].
  const std::vector<Timestamp>& joins() const { return joins_; }
  Timestamp first() const;  ///< returns the stamp of the first message [us]
  /// Returns the number of time steps in [from, to) with other readings than odometry and ground
  /// truth.
  std::size_t readings(const SensorContainer& robot, Timestamp from, Timestamp to) const;
  const Recording& recording() const { return *recording_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Returns the time that is added to the stamps of a piece [us].
  Timestamp shift(std::size_t piece) const { return shifts_.at(piece); }

 private:
  std::shared_ptr<const Recording> recording_;
  std::vector<Piece> pieces_;
  std::vector<Timestamp> shifts_;
  std::vector<Timestamp> joins_;
};

/// Returns a source that plays the splice from its beginning.
/// @param robot says which features are odometry; only used in this call
ORTUNG_API std::unique_ptr<Source> play(std::shared_ptr<const Splice> splice,
                                        const SensorContainer& robot);

}  // namespace ortung

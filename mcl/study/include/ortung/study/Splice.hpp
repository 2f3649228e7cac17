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

/// A piece of a recording: its messages [begin, end), in whole moments.
struct Piece {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Pieces of one recording, joined: time goes on, and odometry does not notice, as if the robot was
/// carried from the end of one to the beginning of the next. It is immutable, so any number of
/// threads may use it.
class ORTUNG_API Splice {
 public:
  /// @throws std::invalid_argument if there is no piece, or one is empty or outside of the
  /// recording
  Splice(std::shared_ptr<const Recording> recording, std::vector<Piece> pieces);
  ~Splice();

  /// Returns the first stamps of all pieces but the first one, when the robot suddenly is
  /// elsewhere.
  const std::vector<Timestamp>& joins() const { return joins_; }
  Timestamp first() const;  ///< stamp of the first message
  /// Returns the number of moments in [from, to) with other readings than odometry and ground
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

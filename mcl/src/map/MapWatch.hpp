#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "NewReadings.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Traceable.hpp"
#include "ortung/mcl/MapChanges.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// Notes where beams contradict what was learned, while the place is known well: a range that is
/// longer than expected says that a wall is gone, a shorter one that something new stands there.
/// People, doors and errors of the place do so, too, but not in one pass of the robot after the
/// other. A range counts only if no beam next to it, as far as the pose is uncertain, is expected
/// to have it. Not thread-safe.
class ORTUNG_API MapWatch {
 public:
  /// A point of the field [m].
  struct Point {
    double x;
    double y;
  };
  /// How far a pose may be off.
  struct Doubt {
    double metres;
    double radians;
  };
  /// Takes the readings that have weighed the belief. @param estimate when they were read
  void follow(const std::vector<NewReading>& news, const PoseEstimate& estimate);
  /// Returns whether anything is sure to have changed.
  bool isSure() const { return !sure_.empty(); }
  /// Returns readings without beams that meet sure changes of the map if the robot is at @p pose;
  /// others stay as they are.
  std::vector<NewReading> withoutChanged(std::vector<NewReading> news, const Pose2& pose) const;
  /// The robot may be anywhere: what was seen in this pass does not count any more.
  void forgetPass();

  MapChanges changes() const;
  void restore(const MapChanges& changes);

 private:
  struct Key {
    MapChange::Kind kind;
    std::int32_t row;
    std::int32_t column;
    auto operator<=>(const Key&) const = default;
  };
  struct Cell {
    // This pass.
    std::uint32_t otherwise = 0;  ///< looks that contradict the map
    std::uint32_t asLearned = 0;  ///< looks that don't
    Timestamp begun = 0;
    Timestamp seen = 0;
    // The passes before.
    MapChange before;
    double points = 0.0;  ///< points of which its middle is the mean
  };
  enum class Verdict : std::uint8_t { kOpen, kOtherwise, kAsLearned };

  static std::optional<Key> keyAt(MapChange::Kind kind, const Point& at);
  static Verdict verdictOf(const Cell& cell);
  static void endPass(Cell& cell);
  static MapChange now(const Key& key, const Cell& cell);
  void look(const std::vector<TracedBeam>& beams, const Doubt& doubt, Timestamp stamp);
  void lookPastNew(const std::vector<TracedBeam>& beams, const Doubt& doubt, Timestamp stamp);
  void note(const Key& key, const std::vector<Point>& otherwise, Timestamp stamp);
  static void count(Cell& cell, bool isOtherwise, Timestamp stamp);
  void tidy(Timestamp stamp);
  void findSure();
  bool isSureNear(MapChange::Kind kind, const TracedBeam& beam, double range) const;

  std::map<Key, Cell> cells_;
  std::set<Key> sure_;
  std::map<const SensorData*, std::optional<Pose2>>
      looked_;  ///< pose of each feature's newest look
  Timestamp tidied_ = 0;
};

}  // namespace ortung

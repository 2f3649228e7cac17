#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/ros2/Messages.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung::ros2 {

/// On which floor of a building the robot is, as it is told to others: what they hear and say is in
/// the frame of that floor, of the first one before any is known. In a field without floors all
/// stays as it is. Thread-safe.
class LiveFloors {
 public:
  static constexpr double kNearlyAll =
      0.9;  ///< share of a belief that settles on which floor it is

  /// Goes on in another building. @param floor on which the robot is there; "": on the one of the
  /// same name, if there is one
  void enter(const Building& building, const std::string& floor = "");
  /// Takes a new estimate and the belief's shares of the floors (Mcl::floorShares). A floor becomes
  /// the robot's when nearly all of the belief is there: who drives by one map is better off with
  /// it than with one that comes and goes.
  void follow(const PoseEstimate& estimate, std::vector<double> shares);
  /// Says that the robot is on a floor. @return whether there is one of that name
  bool goTo(const std::string& floor);

  /// The name of the robot's floor; "" if it is not known, or if there are none.
  std::string name() const;
  /// The floor whose frame counts; nothing: that of the field.
  std::optional<Floor> frame() const;
  /// Whether a pose in the field is on the robot's floor; all are in a field without floors.
  bool isHere(const Pose2& inField) const;
  /// Converts a pose between the field and the frame that counts.
  Pose2 toField(const Pose2& pose) const;
  Pose2 fromField(const Pose2& inField) const;
  /// Returns where a pose of this field is in a building, this or another one, at the same place of
  /// the floor of the same name or of @p floor; nothing if that one is not there.
  std::optional<Pose2> carried(const Pose2& inField, const Building& to,
                               const std::string& floor = "") const;

  /// Adds the floor, and how the belief is shared among floors if it is, to what diagnostics say.
  void describe(DiagnosticArray::Status& status) const;

 private:
  std::size_t index() const { return present_.value_or(0); }
  std::size_t spread() const;

  mutable std::mutex mutex_;
  Building building_;
  std::optional<std::size_t> present_;
  std::vector<double> shares_;  ///< shares of the floors in the last estimate's belief
};

}  // namespace ortung::ros2

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Formation.hpp"
#include "ortung/sim_api/Stage.hpp"

namespace ortung::soccer {

/// Moves robots and ball to their places for a restart: each robot to the nearest permitted and
/// free place to its wish. Robots that are in each other's way are parked aside first.
class Placing {
 public:
  /// All arguments are borrowed.
  Placing(Stage& stage, const Scene& scene, const Pitch& pitch, double restartGap = 0.02);

  /// Places robots and ball. @returns what could not be done, one line each
  std::vector<std::string> place(const std::vector<Wish>& wishes, const Restart& restart);
  /// Places the ball, or beside the place where it is free. Nothing else is moved.
  std::vector<std::string> placeBall(const FloorPoint& at);

 private:
  bool isPermitted(const Wish& wish, double x, double y) const;
  bool isEmpty(std::size_t robot, double x, double y) const;
  bool isOfNobody(const Wish& wish, double x, double y) const;
  bool isThere(const Wish& wish) const;
  bool isFreeOfBall(const FloorPoint& at) const;
  bool put(std::size_t robot, const Pose2& pose);
  bool putExactly(const Wish& wish);
  bool park(const Wish& wish);
  bool putNear(const Wish& wish);
  void settle(std::vector<Wish> pending, std::vector<std::string>& problems);
  template <class Try>
  bool search(const Pose2& around, const Try& attempt) const;

  Stage& stage_;
  const Scene& scene_;
  const Pitch& pitch_;
  double gap_;                ///< gap that is left between bodies [m]
  std::vector<Pose2> poses_;  ///< current poses of the scene's robots
  FloorPoint ball_;           ///< place of the ball at the restart
  bool hasBall_ = false;
  std::vector<Wish> wishes_;
};

}  // namespace ortung::soccer

#pragma once

#include <optional>
#include <string>

#include "Rules.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// Who has touched the ball last, and whether more than one robot has since the restart. A robot
/// touches it when the gap between them is small, or when the ball has changed its velocity near
/// by: a fast ball may come and go between two looks.
class Touches {
 public:
  explicit Touches(double margin) : margin_(margin) {}

  void look(const Scene& scene);
  /// A restart is given: nobody has touched the ball since.
  void reset();
  /// The ball was put elsewhere; who touched it last stays.
  void jump() { before_.reset(); }

  std::optional<std::size_t> lastTeam() const { return lastTeam_; }
  const std::string& lastRobot() const { return lastRobot_; }
  /// Where the ball was when it was last touched [m].
  FloorPoint lastPlace() const { return lastPlace_; }
  /// Robots that had the ball since the restart, one after the other; the same twice counts once.
  int robots() const { return robots_; }

 private:
  bool hasTurned(const Scene::Ball& ball) const;

  double margin_;  ///< [m]
  std::optional<std::size_t> lastTeam_;
  std::string lastRobot_;
  FloorPoint lastPlace_;
  std::string first_;  ///< since the restart
  int robots_ = 0;     ///< 0, 1, or 2 for more than one
  std::optional<Scene::Ball> before_;
  Timestamp at_ = 0;  ///< of before_
};

}  // namespace ortung::soccer

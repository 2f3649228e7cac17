#pragma once

#include <optional>
#include <string>

#include "Rules.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// Records which robot has touched the ball last, and whether more than one has since the restart.
/// A robot touches it when the gap between them is small, or when the ball changes its velocity
/// near it: a fast ball may come and go between two cycles.
class Touches {
 public:
  explicit Touches(double margin) : margin_(margin) {}

  void look(const Scene& scene);
  /// Resets the record at a restart: no robot has touched the ball since.
  void reset();
  /// Notes that the ball was moved; the last touch is kept.
  void jump() { before_.reset(); }

  std::optional<std::size_t> lastTeam() const { return lastTeam_; }
  const std::string& lastRobot() const { return lastRobot_; }
  /// Returns the place of the ball at its last touch [m].
  FloorPoint lastPlace() const { return lastPlace_; }
  /// Returns the number of robots that touched the ball since the restart; 2 stands for two or
  /// more.
  int robots() const { return robots_; }

 private:
  bool hasTurned(const Scene::Ball& ball) const;

  double margin_;  ///< gap below which a robot touches the ball [m]
  std::optional<std::size_t> lastTeam_;
  std::string lastRobot_;
  FloorPoint lastPlace_;
  std::string first_;  ///< first robot that touched it since the restart
  int robots_ = 0;     ///< number of robots that touched it: 0, 1, or 2 for more than one
  std::optional<Scene::Ball> before_;
  Timestamp at_ = 0;  ///< time of before_
};

}  // namespace ortung::soccer

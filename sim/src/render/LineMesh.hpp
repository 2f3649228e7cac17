#pragma once

#include "StandingScene.hpp"

namespace ortung {

/// Makes the triangles of painted lines, in short pieces.
class LineMesh {
 public:
  explicit LineMesh(StandingScene& scene) : scene_(scene) {}
  void add(const FieldLine& line);

 private:
  struct Node {
    double x, y;              ///< point on the line's centre, relative to the scene's middle [m]
    double acrossX, acrossY;  ///< direction to the left
    double endX, endY;        ///< direction out of the line at its ends
    double along;             ///< distance along the line [m]
  };
  void addStraight(const FieldLine& line, Rgba colour);
  void addArc(const FieldLine& line, Rgba colour);
  void addSpot(double x, double y, double radius, Rgba colour);
  void piece(const Node& from, const Node& to, double half, double length, Rgba colour);
  void close(std::size_t firstVertex);

  StandingScene& scene_;
};

}  // namespace ortung

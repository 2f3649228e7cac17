#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "ortung/base/Export.hpp"

namespace ortung {

/// The class of the thing that a pixel shows.
enum class PixelClass : std::uint8_t {
  kBackground,  ///< nothing, or the floor beyond the field
  kField,       ///< the playing field's floor
  kLine,        ///< a line painted on it
  kGoal,        ///< posts and bars of goals
  kPost,        ///< a body of kind "post"
  kBall,        ///< a ball
  kRobot,       ///< a robot's body
  kObstacle,    ///< any other body
  kWall         ///< a wall of the world or of a map
};

/// The pose of a camera. The camera frame has x to the right, y down and z forward.
struct CameraPose {
  std::array<double, 3> position{};  ///< position in the field frame, z above the floor [m]
  /// Row by row: a direction in the field frame = axes * direction in the camera frame.
  std::array<double, 9> axes{};
};

/// A perspective picture that fills a rectangle of a sheet.
struct SheetFace {
  /// Row by row: a direction in the camera frame = inCamera * direction in the face's frame, whose
  /// z axis looks forward, x to the right and y down.
  std::array<double, 9> inCamera{1, 0, 0, 0, 1, 0, 0, 0, 1};
  double left = -1.0, right = 1.0;  ///< x / z at the outer edges of the outermost pixels
  double top = -1.0, bottom = 1.0;  ///< y / z at the outer edges of the outermost pixels
  int column = 0, row = 0;          ///< the place of its upper left pixel on the sheet [pixels]
  int width = 0, height = 0;        ///< size of the face [pixels]
};

using Rgb = std::array<float, 3>;  ///< shares of red, green and blue; 1: as bright as pixels get

/// The light of a scene, and what its floor looks like.
struct Lighting {
  std::array<float, 3> towardsLight{0.3F, 0.2F, 0.93F};  ///< unit vector in the field frame
  /// Share of the light that comes from everywhere; the rest comes from one side.
  float ambient = 0.65F;
  Rgb colour{1.0F, 1.0F, 1.0F};         ///< colour of the light
  Rgb turf{0.10F, 0.42F, 0.16F};        ///< floor of a field with lines
  Rgb ground{0.36F, 0.36F, 0.37F};      ///< any other floor, and the floor beside the field
  Rgb background{0.72F, 0.74F, 0.77F};  ///< colour of pixels that show nothing
  float grain = 0.0F;        ///< how much the floor's brightness varies from blade to blade
  float patches = 0.0F;      ///< how much it varies from place to place
  float stripes = 0.0F;      ///< how much it varies between mown stripes
  float stripeWidth = 1.5F;  ///< width of a mown stripe [m]
  float stripeAngle = 0.0F;  ///< direction along the stripes in the field frame [rad]
  std::uint32_t seed = 0;    ///< seed of the floor's pattern
};

/// The arguments of World::draw(): camera, faces, sheet and light.
struct Drawing {
  CameraPose camera;
  std::span<const SheetFace> faces;  ///< the pictures on the sheet
  int width = 0, height = 0;         ///< size of the sheet [pixels], each at most kMostPixels
  std::uint32_t ignore = 0;          ///< the robot that is not drawn: the camera's own; 0: none
  Lighting lighting;

  static constexpr int kMostPixels = 8192;  ///< longest side of a sheet [pixels]
};

/// The array into which a drawing is written: width * height entries, row by row from the top.
/// Pixels that no face covers have undefined values.
struct Sheet {
  std::span<std::uint32_t> colours;  ///< red + 256 green + 65536 blue + 2^24 * anything
};

/// The rays of a camera's pixels: the arguments of World::trace().
struct Sight {
  CameraPose camera;
  /// Directions in the camera frame, of length 1; (0, 0, 0) for a pixel that shows nothing.
  std::span<const std::array<float, 3>> rays;
  std::uint32_t ignore = 0;  ///< as Drawing::ignore
};

/// The arrays into which World::trace() writes what each ray meets first: as many entries as rays.
struct Traced {
  /// PixelClass + 256 * (place among World::objects() + 1, or 0 for none of them)
  std::span<std::uint32_t> things;
  /// Straight-line distance from the camera [m]; infinity where there is nothing.
  std::span<float> ranges;
};

}  // namespace ortung

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "ortung/base/Export.hpp"

namespace ortung {

/// What a pixel shows.
enum class PixelClass : std::uint8_t {
  background,  ///< nothing, or the floor beyond the field
  field,
  line,
  goal,  ///< posts and bars of goals
  post,
  ball,
  robot,
  obstacle,
  wall
};

/// Where a camera is. Its frame has x to the right, y down and z forward.
struct CameraPose {
  std::array<double, 3> position{};  ///< in the field frame, z above the floor [m]
  /// Row by row: a direction in the field frame = axes * direction in the camera frame.
  std::array<double, 9> axes{};
};

/// A perspective picture that is a part of a sheet.
struct SheetFace {
  /// Row by row: a direction in the camera frame = inCamera * direction in the face's frame, whose
  /// z axis looks forward, x to the right and y down.
  std::array<double, 9> inCamera{1, 0, 0, 0, 1, 0, 0, 0, 1};
  double left = -1.0, right = 1.0;  ///< x / z at the outer edges of the outermost pixels
  double top = -1.0, bottom = 1.0;  ///< y / z there
  int column = 0, row = 0;          ///< of its upper left pixel on the sheet
  int width = 0, height = 0;        ///< [pixels]
};

using Rgb = std::array<float, 3>;  ///< shares of red, green and blue; 1: as bright as pixels get

/// Light, and what a floor looks like.
struct Lighting {
  std::array<float, 3> towardsLight{0.3F, 0.2F, 0.93F};  ///< in the field frame, of length 1
  float ambient = 0.65F;  ///< of the light comes from everywhere; the rest from one side
  Rgb colour{1.0F, 1.0F, 1.0F};
  Rgb turf{0.10F, 0.42F, 0.16F};        ///< of a field with lines
  Rgb ground{0.36F, 0.36F, 0.37F};      ///< of other floors, and beside the field
  Rgb background{0.72F, 0.74F, 0.77F};  ///< where nothing is
  float grain = 0.0F;        ///< how much the floor's brightness varies from blade to blade
  float patches = 0.0F;      ///< ... and from place to place
  float stripes = 0.0F;      ///< ... and between mown stripes
  float stripeWidth = 1.5F;  ///< [m]
  float stripeAngle = 0.0F;  ///< of the way along stripes in the field [rad]
  std::uint32_t seed = 0;    ///< of the floor's pattern
};

/// What is to be drawn.
struct Drawing {
  CameraPose camera;
  std::span<const SheetFace> faces;
  int width = 0, height = 0;  ///< of the sheet [pixels], each at most kMostPixels
  std::uint32_t ignore = 0;   ///< the robot that is not drawn: the camera's own; 0: none
  Lighting lighting;

  static constexpr int kMostPixels = 8192;  ///< of a side
};

/// Where it goes to: width * height entries each, row by row from the top; empty: not wanted. What
/// no face covers is anything.
struct Sheet {
  std::span<std::uint32_t> colours;  ///< red + 256 green + 65536 blue + 2^24 * anything
  /// PixelClass + 256 * (place among World::objects() + 1, or 0 for none of them)
  std::span<std::uint32_t> things;
  std::span<float> ranges;  ///< straight distance from the camera [m]; infinity: nothing there
};

}  // namespace ortung

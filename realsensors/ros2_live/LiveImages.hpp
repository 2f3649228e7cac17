#pragma once

#include <cstdint>
#include <vector>

#include "ortung/camera/CameraModel.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// Returns the words of a picture (ImageData): encodings rgb8, bgr8, rgba8, bgra8, 8UC3 (as bgr8),
/// mono8 and 8UC1.
/// @param size the only one that is taken; 0 x 0: any
/// @throws std::invalid_argument for other encodings and sizes, and for rows that are not there
std::vector<std::uint32_t> wordsOf(const Image& image, ImageSize size);

}  // namespace ortung::ros2

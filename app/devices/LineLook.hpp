#pragma once

#include <filesystem>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/calibration/LineCalibration.hpp"

namespace ortung::app {

/// A picture and the points on lines that were found in it.
struct Look {
  Picture picture;
  LinePicture lines;
};

/// Reads a picture and looks for lines. @throws std::runtime_error if it is no picture
Look lookAt(const std::filesystem::path& file);

/// Looks at all pictures of one camera. @throws std::runtime_error if they have different sizes
std::vector<Look> lookAtAll(const std::vector<std::filesystem::path>& files);

/// Draws a field's lines where a camera would see them (blue), and the points that were found
/// (red).
/// @param pose the pose of the camera's sensor frame in the field frame
void draw(Look& look, const FieldLines& field, const CameraView& view, const Pose2& pose);

}  // namespace ortung::app

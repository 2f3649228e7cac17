#pragma once

#include <memory>
#include <string>

#include "ortung/camera/CameraModel.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {

inline std::shared_ptr<const CameraModel> cameraOf(const std::string& toml) {
  return readCamera(parseToml(toml, "camera.toml"));
}

/// Of every model one, with all its settings away from their defaults.
inline const char* const kPerspective =
    "model = \"perspective\"\nsize_px = [640, 480]\nfocal_px = [420.0, 425.0]\n"
    "centre_px = [322.5, 236.25]\ndistortion = [-0.21, 0.08, 0.0012, -0.0009, -0.012]\n";
inline const char* const kFisheye =
    "model = \"fisheye\"\nsize_px = [608, 800]\nfocal_px = [330.0, 331.5]\n"
    "centre_px = [301.0, 405.0]\ndistortion = [-0.03, 0.012, -0.006, 0.0008]\n";
inline const char* const kUnified =
    "model = \"unified\"\nsize_px = [480, 480]\nxi = 0.93\nfocal_px = [210.0, 211.0]\n"
    "skew_px = 0.4\ncentre_px = [240.5, 238.0]\ndistortion = [-0.05, 0.01, 0.0004, -0.0006]\n";
inline const char* const kOcam =
    "model = \"ocam\"\nsize_px = [1024, 768]\ncentre_px = [510.0, 385.0]\n"
    "polynomial = [190.0, 0.0, -0.0011, -1.5e-7, -1.1e-10]\naffine = [1.0003, 0.0007, -0.0004]\n";
inline const char* const kIsometric =
    "model = \"isometric\"\nsize_px = [480, 480]\npixels_per_m = 40.0\nheight_m = 0.7\n";

}  // namespace ortung
